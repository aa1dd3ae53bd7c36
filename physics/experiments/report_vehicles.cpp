#include "physics/experiments/report_vehicles.h"

#include "physics/experiments/report_labmates.h"

namespace odolab {

namespace {

constexpr double kWheelError = 0.0015;  // of each radius: 0.3 % between two
constexpr double kWheelbaseError = 0.01;
// What an UMBmark calibration of a LabMate leaves of both, by its own standard errors in self-calibration.
constexpr double kLeftOfWheels = 50e-6, kLeftOfWheelbase = 400e-6;
constexpr double kAskew_rad = 0.001;
constexpr double kTrailerWheelError = 0.0003;
constexpr double kTrailerWheelbaseError = 0.001;

DifferentialDrive with_labmate_errors(DifferentialDrive drive, Random& random, Trucks trucks) {
  const double wheels = trucks == Trucks::calibrated ? kLeftOfWheels : kWheelError;
  const double wheelbase = trucks == Trucks::calibrated ? kLeftOfWheelbase : kWheelbaseError;
  drive.wheel_radius_left_m *= 1.0 + random.uniform(-wheels, wheels);
  drive.wheel_radius_right_m *= 1.0 + random.uniform(-wheels, wheels);
  drive.wheelbase_m *= 1.0 + random.uniform(-wheelbase, wheelbase);
  return drive;
}

void take_andros(Scenario& scenario) {
  scenario.actual.mass_kg = 200.0;
  scenario.actual.moment_of_inertia_kgm2 = 20.0;
  scenario.motor.ideal = true;
  scenario.driving.by_eye = true;
}

}  // namespace

Scenario k2a_on_report_squares(Random& random) {
  Scenario scenario = on_report_squares();
  scenario.vehicle.name = "Cybermotion K2A";
  scenario.vehicle.kind = SynchroDrive{};
  scenario.actual.mass_kg = 125.0;
  scenario.actual.moment_of_inertia_kgm2 = 8.0;
  for (double& share : scenario.machine.synchro.radius_error) share = random.uniform(-kWheelError, kWheelError);
  for (double& askew_rad : scenario.machine.synchro.misalignment_rad)
    askew_rad = random.uniform(-kAskew_rad, kAskew_rad);
  return scenario;
}

std::string k2a_assumption() {
  return "K2A: no dimensions are published; wheels of 127 mm radius on a circle of 250 mm, rubber that creeps (12 "
         "times "
         "the load for a slip of one), up to 0.3 % between the wheels as for the LabMates, up to 1 mrad askew, exact "
         "steering gears";
}

Scenario clapper_on_report_rectangle(Random& random, Trucks trucks, double tape) {
  Scenario scenario = on_report_squares();
  scenario.vehicle.name = "CLAPPER";
  const Clapper nominal;
  scenario.vehicle.kind = nominal;
  Clapper actual = nominal;
  actual.truck_a = with_labmate_errors(nominal.truck_a, random, trucks);
  actual.truck_b = with_labmate_errors(nominal.truck_b, random, trucks);
  scenario.machine.lengths = actual;
  Clapper measured = nominal;
  for (DifferentialDrive* truck : {&measured.truck_a, &measured.truck_b}) {
    truck->wheel_radius_left_m *= tape;
    truck->wheel_radius_right_m *= tape;
  }
  scenario.vehicle.kind = measured;
  scenario.path = RectanglePath{};
  scenario.driving.speed_mps = 0.45;
  scenario.driving.turn_rate_radps = 0.3;
  scenario.driving.turn_acceleration_radps2 = 0.25;
  scenario.sensors.encoder_period_s = 0.04;
  return scenario;
}

std::string clapper_assumption() {
  return "CLAPPER: 7 x 4 m at 0.45 m/s without stops, as the report drove it; encoders of the link without bias, as "
         "after "
         "its \"extensive trial-and-error calibration\"; calibrated trucks within 50 ppm of their wheels and 400 ppm "
         "of their "
         "wheelbase, uncalibrated ones within 0.15 % and 1 %";
}

Scenario andros_on_report_squares() {
  Scenario scenario = on_report_squares();
  scenario.vehicle.name = "Remotec Andros";
  scenario.vehicle.kind = Tracked{};
  take_andros(scenario);
  return scenario;
}

std::string andros_assumption() {
  return "Andros: no dimensions are published; tracks 0.50 m apart and 0.70 m long on the floor with eight pads each, "
         "200 kg, driven by a person who sees where it is";
}

Scenario andros_with_trailer_on_report_squares(Random& random) {
  Scenario scenario = on_report_squares();
  scenario.vehicle.name = "Andros with Basic Encoder Trailer";
  EncoderTrailer nominal;
  nominal.tow = as_differential_drive(Tracked{});
  scenario.vehicle.kind = nominal;
  EncoderTrailer actual = nominal;
  actual.trailer.wheel_radius_left_m *= 1.0 + random.uniform(-kTrailerWheelError, kTrailerWheelError);
  actual.trailer.wheel_radius_right_m *= 1.0 + random.uniform(-kTrailerWheelError, kTrailerWheelError);
  actual.trailer.wheelbase_m *= 1.0 + random.uniform(-kTrailerWheelbaseError, kTrailerWheelbaseError);
  scenario.machine.lengths = actual;
  take_andros(scenario);
  return scenario;
}

std::string trailer_assumption() {
  return "trailer: wheels of 50 mm radius 0.30 m apart, 0.40 m behind a hitch 0.50 m behind the Andros's middle; hard "
         "narrow wheels made to 0.03 % of their radius and 0.1 % of their distance";
}

Scenario labmate_with_smart_trailer_on_report_squares() {
  Scenario scenario = on_report_squares();
  scenario.vehicle.name = "LabMate with Smart Encoder Trailer";
  const SmartEncoderTrailer nominal;
  scenario.vehicle.kind = nominal;
  SmartEncoderTrailer actual = nominal;
  constexpr double kRatio = 0.9985;
  actual.tow.wheelbase_m = 0.337;
  actual.tow.wheel_radius_left_m *= 2.0 / (kRatio + 1.0);
  actual.tow.wheel_radius_right_m *= 2.0 * kRatio / (kRatio + 1.0);
  scenario.machine.lengths = actual;
  scenario.sensors.encoder_period_s = 0.04;
  return scenario;
}

void put_ten_cables(Floor& floor) {
  for (int i = 1; i <= 10; ++i) {
    Bump cable;
    cable.centre = {0.36 * i, 0.0};
    cable.length_m = 1.5;
    cable.under = Under::inside_wheel;
    floor.bumps.push_back(cable);
  }
}

}  // namespace odolab
