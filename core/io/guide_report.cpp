#include "core/io/guide_report.h"

#include <cmath>

#include "core/guide/misfit.h"
#include "core/io/diagnosis_text.h"
#include "core/io/number_text.h"
#include "core/io/picture/scatter_picture.h"
#include "core/io/ros2_yaml.h"

namespace odolab {

namespace {

void add_settings(HtmlReport& report, const GuideOutcome& outcome) {
  report.heading("Put these numbers into the robot");
  std::vector<std::vector<std::string>> rows;
  bool any_ros2 = false;
  for (const Setting& s : outcome.settings) any_ros2 = any_ros2 || !s.ros2.empty();
  for (const Setting& s : outcome.settings) {
    std::vector<std::string> row{s.words, quantity_text(s.before, 0.0, s.unit),
                                 s.determined ? quantity_text(s.value, s.stderr_value, s.unit) : "not determined",
                                 s.file_has_half ? s.key + " (half)" : s.key};
    if (any_ros2) row.push_back(s.ros2);
    rows.push_back(row);
  }
  std::vector<std::string> header{"what", "before", "now", "vehicle file"};
  if (any_ros2) header.push_back("ROS 2 diff_drive_controller");
  report.word_table(header, rows);
}

void add_rounds(HtmlReport& report, const GuideSession& session, const GuideOutcome& outcome) {
  std::vector<DrawnUmbmark> drawn;
  for (std::size_t k = 0; k < outcome.rounds.size(); ++k)
    drawn.push_back({k == 0   ? "before"
                     : k == 1 ? "after calibration"
                              : "after a second compensation",
                     outcome.rounds[k].runs});
  if (!drawn.empty()) report.picture(scatter_picture({"Return position errors of the square", drawn}));
  const auto table = [&](const GuideRound& round, const std::string& title) {
    if (round.runs.empty()) return;
    report.heading(title);
    report.paragraph("Driven with a left wheel diameter of " +
                     number_text("%.3f", 2e3 * round.nominal.wheel_radius_left_m) + " mm, a right one of " +
                     number_text("%.3f", 2e3 * round.nominal.wheel_radius_right_m) + " mm and a wheelbase of " +
                     number_text("%.3f", 1e3 * round.nominal.wheelbase_m) + " mm.");
    const std::vector<bool> marked = misfits(round);
    std::vector<std::vector<std::string>> rows;
    int number[2] = {0, 0};
    for (std::size_t i = 0; i < round.runs.size(); ++i) {
      const GuideRun& run = round.runs[i];
      const ReturnError e = return_error(run);
      rows.push_back({(run.clockwise ? "cw " : "ccw ") + std::to_string(++number[run.clockwise]),
                      number_text("%.1f", 1e3 * e.x_m), number_text("%.1f", 1e3 * e.y_m),
                      run.has_heading ? number_text("%.2f", degrees(e.heading_rad)) : "",
                      run.left_out ? "left out"
                      : marked[i]  ? "does not fit the others"
                                   : "",
                      run.source});
    }
    report.table({"run", "x [mm]", "y [mm]", "heading [degrees]", "", "from"}, rows);
  };
  for (std::size_t k = 0; k < session.rounds.size(); ++k)
    table(session.rounds[k], k == 0 ? "Runs" : k == 1 ? "Runs after calibration" : "Runs after a second compensation");
  table(session.bumped, "Runs over ten bumps");
  report.paragraph("Return errors: absolute minus calculated pose at the end (Eq. 3.1).");
  report.paragraph(misfit_rule());
}

}  // namespace

HtmlReport guide_report(const GuideSession& session, const GuideOutcome& outcome) {
  const Guide& guide = guide_of(session.kind);
  HtmlReport report(guide.name + ": " + session.vehicle.name);
  report.paragraph(std::string("A ") + (session.real_robot ? "real" : "simulated") + " robot. " + guide.about);
  for (const std::string& sentence : outcome.sentences) report.sentence(sentence);
  for (const std::string& warning : outcome.warnings) report.paragraph("Note: " + warning);
  if (!outcome.settings.empty()) add_settings(report, outcome);
  if (outcome.scale)
    report.paragraph("Scale, by the tape: believed " + number_text("%.4f", session.tape->calculated_m) +
                     " m, measured " + number_text("%.4f", session.tape->actual_m) +
                     " m, Es = " + number_text("%.5f", outcome.scale->scaling_error) + " ± " +
                     number_text("%.5f", outcome.scale->scaling_error_stderr) + " (Eq. B.1).");
  if (guide.kind == GuideKind::umbmark || guide.kind == GuideKind::extended_umbmark)
    add_rounds(report, session, outcome);
  if (!outcome.held_out.empty()) {
    report.heading("Drives that the calibration has not seen");
    std::vector<std::vector<std::string>> rows;
    for (const HeldOutError& e : outcome.held_out)
      rows.push_back({e.name, number_text("%.1f", 1e3 * e.before_m), number_text("%.1f", 1e3 * e.after_m),
                      number_text("%.2f", degrees(e.before_rad)), number_text("%.2f", degrees(e.after_rad))});
    report.table({"drive", "before [mm]", "after [mm]", "before [degrees]", "after [degrees]"}, rows);
    report.paragraph("How far the odometry ends from the true pose.");
  }
  if (!session.recordings.empty()) {
    report.heading("Recordings");
    std::vector<std::vector<std::string>> rows;
    for (const std::string& file : session.recordings) rows.push_back({file});
    report.word_table({"file"}, rows);
  }
  return report;
}

}  // namespace odolab
