// First, back, play, forward, last; the speed wanted and reached; a timeline, and the error over time above it.
#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "ui/actions.h"
#include "ui/look/theme.h"
#include "ui/plot/plot.h"

namespace odolab::ui {

struct TimelineEvent {
  double time_s = 0.0;
  std::string words;
  ImU32 colour = 0;
};

// A curve over time, e.g. the gap.
struct TimeCurve {
  std::string label;
  const std::vector<double>* time_s = nullptr;
  const std::vector<double>* value = nullptr;
  ImU32 colour = 0;
  Stroke stroke = Stroke::line;
};

struct Transport {
  bool playing = false;
  bool finished = false;
  bool total_is_planned = false;  // how long it takes is known to a few percent
  bool enabled = true;
  std::string why_disabled;
  bool can_step_back = true;
  double time_s = 0.0;    // shown
  double latest_s = 0.0;  // simulated so far
  double total_s = 1.0;   // where the time axis ends: the larger of what is planned and what was
  double speed = 1.0;     // wanted; 0: as fast as possible
  double reached_speed = 0.0;
  std::string quantity = "gap";
  std::string empty_text;                  // said in the plot while there is no curve
  std::vector<TimeCurve> position_curves;  // metres
  std::vector<TimeCurve> heading_curves;   // radians
  std::vector<TimelineEvent> events;
};

struct TransportState {
  PlotView view;
  bool show_heading = false;
};

// The curves of the kind and the range of time that the plot shows, as columns: "position_gap_m", "dead_reckoning_rad".
Recording shown_curves(const Transport& transport, const TransportState& state);

// Where on the timeline a time lies and back: a straight map of [0, total] on [left, right], clamped.
double time_at(float x, float left, float right, double total_s);
float x_of_time(double time_s, float left, float right, double total_s);

Actions transport_bar(const Transport& transport, TransportState& state, const Theme& theme);

}  // namespace odolab::ui
