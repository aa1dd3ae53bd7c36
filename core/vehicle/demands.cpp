#include "core/vehicle/demands.h"

#include <cmath>

#include "core/base/formatted.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

namespace {

std::string text_of(double value) { return formatted("%g", value); }

}  // namespace

void Demands::add(const std::string& key, const std::string& found, const std::string& expected) {
  problems_.push_back(prefix_ + key + ": found " + found + ", expected " + expected);
}

void Demands::add(const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) problems_.push_back(prefix_ + problem);
}

void Demands::fail(const char* key, double value, const std::string& expected) { add(key, text_of(value), expected); }

void Demands::above_zero(const char* key, double value, const char* what) {
  if (!(std::isfinite(value) && value > 0.0)) fail(key, value, std::string(what) + " above 0");
}

void Demands::length_below(const char* key, double value_m, double limit_m) {
  if (value_m > limit_m) fail(key, value_m, "a length in metres below " + text_of(limit_m));
}

void Demands::zero_or_more(const char* key, double value, const char* what) {
  if (!(std::isfinite(value) && value >= 0.0)) fail(key, value, std::string(what) + ", 0 or more");
}

void Demands::within(const char* key, double value, double limit, const char* what) {
  if (!(std::abs(value) <= limit)) fail(key, value, std::string(what) + " within " + text_of(limit) + " of 0");
}

void Demands::number(const char* key, double value, const char* what) {
  if (!std::isfinite(value)) fail(key, value, what);
}

void Demands::wheels(double radius_left_m, double radius_right_m, double wheelbase_m) {
  above_zero("wheel_radius_left_m", radius_left_m, "a length in metres");
  above_zero("wheel_radius_right_m", radius_right_m, "a length in metres");
  above_zero("wheelbase_m", wheelbase_m, "a length in metres");
  length_below("wheel_radius_left_m", radius_left_m, 10.0);
  length_below("wheel_radius_right_m", radius_right_m, 10.0);
  length_below("wheelbase_m", wheelbase_m, 50.0);
}

void Demands::counter_bits(int bits) {
  if (bits < 0 || bits > 62) add("counter_bits", std::to_string(bits), "0 (never wraps) to 62");
}

std::vector<std::string> problems_in_truck(const char* name, const DifferentialDrive& truck) {
  Demands demands(std::string(name) + ".");
  demands.add(problems_in(truck));
  return std::move(demands).problems();
}

}  // namespace odolab
