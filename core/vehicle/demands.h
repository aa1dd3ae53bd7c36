// What a number of a vehicle file must be, and the sentence where it is not.
#pragma once

#include <string>
#include <vector>

namespace odolab {

struct DifferentialDrive;

// Collects problems, each a sentence "key: found …, expected …" whose key starts with the prefix.
class Demands {
 public:
  explicit Demands(std::string key_prefix = "") : prefix_(std::move(key_prefix)) {}

  void above_zero(const char* key, double value, const char* what);
  void length_below(const char* key, double value_m, double limit_m);  // beyond it, most likely millimetres
  void zero_or_more(const char* key, double value, const char* what);
  void within(const char* key, double value, double limit, const char* what);  // of zero, both ways
  void number(const char* key, double value, const char* what);                // any, but finite
  // The lengths of two wheels on one axle, as in DifferentialDrive.
  void wheels(double radius_left_m, double radius_right_m, double wheelbase_m);
  void counter_bits(int bits);
  void add(const std::string& key, const std::string& found, const std::string& expected);
  void add(const std::vector<std::string>& problems);  // of a part, with the prefix put before them

  std::vector<std::string> problems() && { return std::move(problems_); }

 private:
  void fail(const char* key, double value, const std::string& expected);

  std::string prefix_;
  std::vector<std::string> problems_;
};

// The wheels of a truck that is part of a vehicle: its lengths and counts, keys under "name.".
std::vector<std::string> problems_in_truck(const char* name, const DifferentialDrive& truck);

}  // namespace odolab
