// The guides: a calibration as a list of pages, each with what a person does there. Data; README.md says how one reads.
#pragma once

#include <string>
#include <vector>

#include "core/vehicle/vehicle.h"

namespace odolab {

enum class GuideKind { umbmark, extended_umbmark, castors, linked };

// What a page asks for. The window knows each task once, in whatever guide it stands.
enum class PageTask {
  robot,       // which vehicle, real or simulated
  tape,        // one straight drive beside a tape measure
  drive,       // what to drive, with a drawing
  runs,        // return poses of squares, both ways
  bumps,       // the same over bumps, with headings
  result,      // the numbers and where they go
  again,       // the squares once more with the corrected settings
  verdict,     // what that shows; perhaps a second compensation
  held_out,    // drives that the calibration has not seen, before and after
  recordings,  // files with the vehicle's own encoders
  finish,      // what to take away
};

struct GuidePage {
  PageTask task = PageTask::robot;
  std::string title;
  std::vector<std::string> words;              // paragraphs for everybody
  std::vector<std::string> for_the_real;       // then these, with a real robot
  std::vector<std::string> for_the_simulated;  // or these, with a simulated one
};

struct Guide {
  GuideKind kind = GuideKind::umbmark;
  std::string key;    // "umbmark"; stands in session files
  std::string name;   // on the screen
  std::string about;  // in one sentence
  std::vector<GuidePage> pages;
};

const std::vector<Guide>& guides();
const Guide& guide_of(GuideKind kind);

// Why this guide cannot calibrate the vehicle, in one sentence; empty where it can.
std::string why_not(const Guide& guide, const Vehicle& vehicle);

}  // namespace odolab
