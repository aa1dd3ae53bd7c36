// What there is to see on the floor at one moment. Everything belongs to the caller.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry/track.h"
#include "core/scenario/scenario.h"
#include "physics/vehicles/vehicle_shape.h"
#include "ui/floor/trail.h"
#include "ui/look/theme.h"

namespace odolab::ui {

enum class Dash { solid, dashes, dots, long_dashes };

// A track as it is drawn, up to a time. Where a reference is given, the deviation from it can be exaggerated.
struct TrackLine {
  std::string label;
  const Track* track = nullptr;
  const Track* reference = nullptr;
  double until_s = 1e300;
  std::optional<Pose> end;  // drawn up to here, beyond the last sample
  ImU32 colour = 0;
  Dash dash = Dash::solid;
};

// A vehicle as it is drawn: solid for the real one, an outline for what an estimate believes.
struct VehicleGlyph {
  const VehicleShape* shape = nullptr;
  VehiclePosture posture;
  Pose pose;  // where its reference is drawn, and all its parts about it
  bool outline = false;
  ImU32 colour = 0;
};

// A way that is drawn under the tracks.
struct FloorTrail {
  const Trail* trail = nullptr;
  bool by_mismatch = false;  // coloured by size, and the scale is shown; else in one colour
  ImU32 colour = 0;
  std::vector<Stretch> lit;  // these parts stand out
  bool aside = false;        // need not be in sight
};

// A place that was located.
struct FloorDisc {
  Vec2 centre;
  double radius_m = 0.0;
  std::string label;
};

struct FloorScene {
  const Floor* floor = nullptr;  // null: nothing on it
  bool editable = false;
  std::vector<Vec2> planned;  // the path the driver means to follow
  std::string planned_name = "planned";
  std::vector<FloorTrail> trails;
  std::vector<FloorDisc> discs;
  bool brushable = false;  // a rectangle can be drawn to choose what is in it
  std::vector<TrackLine> tracks;
  std::vector<VehicleGlyph> vehicles;
  // The two poses whose gap matters, for the gap line and the lens; the second deviates from the first.
  std::optional<Pose> reference, deviating;
  double push_ns = 20.0;   // that a click gives the vehicle
  std::string empty_text;  // said in the middle while there is nothing else to see
  std::string reference_name = "true", deviating_name = "estimated";
};

}  // namespace odolab::ui
