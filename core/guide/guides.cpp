#include "core/calibration/internal.h"
#include "core/guide/guide.h"
#include "core/vehicle/parameters.h"

namespace odolab {

namespace {

GuidePage robot_page(std::string words) {
  return {PageTask::robot,
          "The robot",
          {std::move(words)},
          {"Give the numbers that the robot's odometry works with now: read them from its settings, not from its "
           "drawing. Open a vehicle file, or type them."},
          {"The robot is the one of Drive: its odometry believes the numbers below, and its machine is a little "
           "different."}};
}

GuidePage square_page() {
  return {
      PageTask::drive,
      "What to drive",
      {"A square, first turning right at every corner (clockwise), then turning left (counter-clockwise). The robot "
       "stops at each corner and turns on the spot, four turns in all, so that it ends where it began, as it "
       "believes."},
      {"Put the robot at the start, facing along the first side. Mark where its wheels touch the floor, and set its "
       "odometry to x = 0, y = 0, heading 0.",
       "Drive slowly, about 0.2 m/s, on a smooth floor: bumps and slip are chance, and chance is what five runs "
       "average away.",
       "At the end write down what the odometry says, and measure from the mark where the robot really stands: x "
       "forward along the first side, y to its left, both in millimetres. Put it back onto the mark for each run."},
      {"The simulation drives the squares and measures their ends as a sonar corner would."}};
}

GuidePage runs_page(PageTask task, std::string title, std::string words) {
  return {task,
          std::move(title),
          {std::move(words)},
          {"For each run: where it really stands against the mark, and what its odometry says. A recording with the "
           "true pose at its start and end can be dropped on this window instead."},
          {"Press Drive; each square that comes home becomes a point."}};
}

GuidePage held_out_page() {
  return {PageTask::held_out,
          "Does it hold?",
          {"Drives that the calibration has not seen, with the numbers as they were and with the new ones. Only this "
           "shows that they are right, and not only fitted."},
          {"Drop one or more recordings that know the true pose at their start and end, headings included. What the "
           "odometry makes of them is compared with that."},
          {"Press Drive: the calibrated robot drives another way, and the simulation knows the truth."}};
}

GuidePage vehicle_file_page() {
  return {PageTask::finish, "Take it along", {"The calibrated vehicle file, and a page that tells how."}, {}, {}};
}

Guide umbmark_guide() {
  return {
      GuideKind::umbmark,
      "umbmark",
      "UMBmark",
      "Wheel diameters and wheelbase of a differential drive, from squares driven both ways.",
      {robot_page("Two errors bend a differential drive's odometry: wheels that are not equal, and a wheelbase that is "
                  "not the one believed. Half an hour with a tape measure finds both."),
       {PageTask::tape,
        "The scale",
        {"Squares cannot see an error that both wheels share: a robot that believes 4.00 m and drives 4.04 m still "
         "closes its square. One straight drive beside a tape measure finds it (report, Appendix B)."},
        {"Drive about 4 m straight ahead. Read the distance from the robot's odometry, and measure it with the tape."},
        {"Press Drive: the simulated robot goes 4 m, and a tape that is good to the accuracy below is read."}},
       square_page(),
       runs_page(PageTask::runs, "The runs",
                 "Five squares each way make two clouds. Their centres are what is systematic; their width is chance."),
       {PageTask::result,
        "The result",
        {"What the two clouds say about the robot, each number with its uncertainty and the setting it goes into.",
         "They are fitted to the exact path of the square; the report's formulas (Eqs. 6.22 and 6.26), which are good "
         "for small errors, differ from them in the third digit."},
        {"Put these numbers into the robot before going on."},
        {}},
       runs_page(PageTask::again, "Once more",
                 "The same squares with the corrected settings. Only this shows that the calibration holds."),
       {PageTask::verdict,
        "Good enough?",
        {"The rule of the report (section 6.3): a rest above three standard errors of its own centre is worth a second "
         "compensation; below that it would fit chance."},
        {},
        {}},
       {PageTask::finish,
        "Take it along",
        {"The calibrated numbers as a vehicle file, as settings of ROS 2's diff_drive_controller, and as a page that "
         "tells how they were found."},
        {},
        {}}}};
}

Guide extended_guide() {
  return {
      GuideKind::extended_umbmark,
      "extended_umbmark",
      "Extended UMBmark",
      "How far bumps turn a differential drive: the measure of what calibration cannot remove.",
      {robot_page("Calibrate the robot first: what is systematic is taken off here, and should be small. What is "
                  "left is how much ten bumps turn the robot (report, section 3.4)."),
       {PageTask::drive,
        "What to drive",
        {"The same square as in UMBmark, first on the smooth floor, then with ten bumps on the first side.",
         "A bump is a round cable of 10 mm. All ten lie under the wheel that faces the inside of the square: the "
         "right one when it turns right, the left one when it turns left."},
        {"Measure the heading too: mark the robot's two sides at the start, and read how far each is off at the end; "
         "their difference over their distance is the heading error."},
        {"The simulation lays the cables and drives."}},
       runs_page(PageTask::runs, "Smooth floor",
                 "A few squares each way without bumps: their headings are the bias "
                 "that is taken off."),
       runs_page(PageTask::bumps, "Ten bumps",
                 "The same squares over the ten bumps. It is the heading that counts, "
                 "not the place."),
       {PageTask::result,
        "The result",
        {"The average absolute heading error, with the bias of the smooth floor taken off (Eqs. 3.5 and 3.6)."},
        {},
        {}},
       {PageTask::finish, "Take it along", {"A page that tells what was driven and what came out."}, {}, {}}}};
}

Guide castor_guide() {
  return {GuideKind::castors,
          "castors",
          "Castors, from the inside",
          "Every wheel radius, offset and pivot encoder of a multi-castor vehicle, from its own encoders alone.",
          {robot_page("The castors' encoders contradict each other where a number is wrong. No outside measurement is "
                      "needed, but for the distances between the pivots."),
           {PageTask::drive,
            "What to drive",
            {"Hold one castor still, its wheels braked, and let the others drive the vehicle about it: once clockwise "
             "and once counter-clockwise, a quarter of a turn or more. Then the same about the next castor. Two runs "
             "for each castor (multi-castor paper, section III.A)."},
            {"Record all wheel and pivot encoders of each run in a file of its own."},
            {"The simulation holds and drives a machine whose numbers are off by the errors of the paper's Table I; "
             "its wheels never slip."}},
           {PageTask::recordings,
            "The recordings",
            {"One file for each run. Which castor stood still and which way it went is read from the file."},
            {"Drop the files on this window."},
            {"Press Drive."}},
           {PageTask::result,
            "The result",
            {"Each number with its uncertainty, which is that of the encoders' steps."},
            {},
            {}},
           held_out_page(),
           vehicle_file_page()}};
}

Guide linked_guide() {
  return {
      GuideKind::linked,
      "linked",
      "CLAPPER: the link's encoders",
      "Biased encoders of a compliant link, and both trucks' wheels, from what they contradict in each other.",
      {robot_page("The link's encoders say how the trucks stand to each other; so do the wheels. Where both disagree "
                  "for long, a number is wrong: a biased rotary or linear encoder, or the wheels (CLAPPER paper, "
                  "sections 5.1 and 5.2)."),
       {PageTask::drive,
        "What to drive",
        {"Forward, backward, sideways and about itself, a few metres each. Driving in line alone cannot tell a "
         "biased rotary encoder from unequal wheels: both curve the path. Driving sideways tells them apart."},
        {"Record both trucks' wheels, both link angles and the link's length."},
        {"The simulation drives a rectangle and a set of manoeuvres."}},
       {PageTask::recordings,
        "The recordings",
        {"One file or several; what one lacks another may have."},
        {"Drop the files on this window."},
        {"Press Drive."}},
       {PageTask::result,
        "The result",
        {"Each number with its uncertainty. What the drives could not tell keeps its value, and is said."},
        {},
        {}},
       held_out_page(),
       vehicle_file_page()}};
}

}  // namespace

const std::vector<Guide>& guides() {
  static const std::vector<Guide> all{umbmark_guide(), extended_guide(), castor_guide(), linked_guide()};
  return all;
}

const Guide& guide_of(GuideKind kind) { return guides()[static_cast<std::size_t>(kind)]; }

std::string why_not(const Guide& guide, const Vehicle& vehicle) {
  const bool drive = std::holds_alternative<DifferentialDrive>(vehicle.kind);
  const bool castors = std::holds_alternative<MultiCastor>(vehicle.kind);
  const std::string but = "; the vehicle is another: " + words_of(vehicle.kind) + ".";
  switch (guide.kind) {
    case GuideKind::umbmark:
    case GuideKind::extended_umbmark:
      return drive ? "" : "This guide is for differential drives" + but;
    case GuideKind::castors:
      return castors ? "" : "This guide is for vehicles on castors" + but;
    case GuideKind::linked:
      return can_calibrate_internally(vehicle) && !castors ? "" : "This guide is for two linked trucks" + but;
  }
  return "";
}

}  // namespace odolab
