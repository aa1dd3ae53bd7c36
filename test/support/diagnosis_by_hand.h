// A diagnosis written down by hand: every part of it filled in, with numbers that can be found again in what is made of it.
#pragma once

#include <cmath>

#include "core/diagnosis/diagnosis.h"

namespace odolab::test {

inline Residuals square_residuals(const std::string& recording, double bad, double noise_phase) {
  Residuals r;
  r.recording = recording;
  for (int i = 0; i < 1600; ++i) {  // once around a square of 4 m at 0.4 m/s, 40 Hz
    const double t = i / 40.0, s = 0.4 * t, side = std::floor(s / 4.0), along = s - 4.0 * side;
    const double x = side == 0 ? along : side == 1 ? 4.0 : side == 2 ? 4.0 - along : 0.0;
    const double y = side == 0 ? 0.0 : side == 1 ? along : side == 2 ? 4.0 : 4.0 - along;
    const double noise = 0.7 + 0.6 * std::pow(std::sin(12.9 * i + noise_phase), 2.0);
    const bool inside = std::hypot(x - 2.2, y - 0.1) < 0.7;
    r.time_s.push_back(t);
    r.x_m.push_back(x);
    r.y_m.push_back(y);
    r.along_m.push_back(1e-3 * std::sin(2.0 * t));
    r.across_m.push_back(1e-3 * std::cos(2.0 * t));
    r.heading_rad.push_back(1e-3 * std::sin(3.0 * t));
    r.squared.push_back(noise + (inside ? bad : 0.25 * bad * std::pow(std::sin(0.4 * t / 0.15), 2.0)));
  }
  return r;
}

inline Diagnosis diagnosis_by_hand() {
  Diagnosis d;
  d.verdict = Verdict::found;
  DifferentialDrive drive;
  drive.wheel_radius_left_m = 0.0751;
  d.calibration.vehicle.kind = drive;
  d.calibration.parameters = {{"wheel_radius_left_m", "m", 0.075, 0.0751, 2e-6, true},
                              {"wheel_radius_right_m", "m", 0.075, 0.0749, 3e-6, true},
                              {"wheelbase_m", "m", 0.34, 0.3412, 4e-5, true},
                              {"truth_mounting.x_m", "m", 0.0, 0.0, 0.0, false}};
  d.calibration.noise = {0.0006, 0.001, 0.002};
  Finding eccentric;
  eccentric.effect = "wheel_eccentricity";
  eccentric.component = "left_wheel";
  eccentric.parameters = {{"amplitude", 0.006, 0.0001, "1"}, {"phase_rad", 1.21, 0.017, "rad"}};
  eccentric.where.regime = "once in each turn of the wheel, at every speed";
  eccentric.log_likelihood_gain = 412.0;
  eccentric.p_value = 1e-12;
  eccentric.alternatives = {{"wheel_eccentricity", "right_wheel", 3.1, "arcs, which de-phase the wheels"}};
  eccentric.share_of_mismatch = 0.83;
  eccentric.moves = MovedTrack{0.0021, 0.0087};
  eccentric.sentence = "The left wheel rolls 0.6 % too far and too short in turn, once in each of its revolutions.";
  Finding zone;
  zone.effect = "slip_zone";
  zone.component = "floor";
  zone.parameters = {{"slip", 0.104, 0.006, "1"}};
  zone.where.time_s = {{3.75, 7.25}};
  zone.where.recording = "run_3.csv";
  zone.where.zone = WhereFound::Zone{2.2, 0.1, 0.7};
  zone.log_likelihood_gain = 96.0;
  zone.p_value = 1e-7;
  zone.alternatives = {{"bump", "both_wheels", 31.0, "the same place again, more slowly"},
                       {"collision", "vehicle", 12.0, "the same place again"}};
  zone.share_of_mismatch = 0.12;
  zone.sentence = "On a patch of floor 1.4 m across, at x 2.2 m and y 0.1 m, the wheels slip by a tenth.";
  d.findings = {eccentric, zone};
  d.train = {FitFigures{0.0172, 0.0131, 61.0}, FitFigures{0.0061, 0.0092, 8.4}, FitFigures{0.0017, 0.0023, 1.03},
             FitFigures{0.0016, 0.0022, 1.0}, FitFigures{0.0031, 0.0044, 2.1}, FitFigures{0.0061, 0.0092, 8.4}};
  d.held_out = {FitFigures{0.0181, 0.0140, 66.0}, FitFigures{0.0065, 0.0097, 9.1}, FitFigures{0.0019, 0.0025, 1.09},
                FitFigures{0.0017, 0.0022, 1.0}, FitFigures{0.0052, 0.0071, 5.6}, FitFigures{0.0066, 0.0097, 9.2}};
  d.simulation.calibrated = FitFigures{0.0064, 0.0095, 8.8};
  d.simulation.with_findings = FitFigures{0.0020, 0.0027, 1.2};
  AskedEffect slip;
  slip.effect = "lateral_slip";
  slip.component = "vehicle";
  slip.log_likelihood_gain = 1.5;
  slip.gain_beside_findings = 0.25;
  slip.survives = 0.004;
  slip.bends = FoundParameter{"truth_mounting.x_m", 0.0031, 0.0, "m"};
  d.asked = {slip};
  d.not_testable = {{"lateral_slip", "no arc was driven at two speeds", "arcs of 1 m radius at 0.2 and 0.6 m/s"},
                    {"castor_reversal_kick", "the robot never reversed", "three metres forward and back"}};
  d.next_drive = "Two arcs of 1 m radius, at 0.2 and 0.6 m/s, 40 s in all.";
  d.warnings = {"run_2.csv: 3 truth samples jump away from their neighbours and were set aside"};
  Response response{"left wheel angle [rad]", "along [mm per m]", {}, {}, {}, {}, {}};
  for (int i = 0; i <= 24; ++i) {
    const double a = 2.0 * 3.14159265358979 * i / 24.0;
    response.at.push_back(a);
    response.value.push_back(6.0 * std::sin(a + 1.2) + 0.3 * std::sin(7.0 * i));
    response.low.push_back(response.value.back() - 0.8);
    response.high.push_back(response.value.back() + 0.8);
  }
  d.responses = {response};
  d.residuals_before = {square_residuals("run_3.csv", 40.0, 0.0), square_residuals("run_4.csv", 25.0, 1.0)};
  d.residuals_after = {square_residuals("run_3.csv", 0.2, 2.0), square_residuals("run_4.csv", 0.1, 3.0)};
  return d;
}

}  // namespace odolab::test
