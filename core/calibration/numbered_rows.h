// Which number each row of a log has whose rows were taken at one period: missing ones are counted.
#pragma once

#include <vector>

namespace odolab {

constexpr int kPausePeriods = 20;  // a longer gap is a pause, behind which numbers begin anew

// By stamps of arrival in their order. Nothing where these do not tell. `period_s`, that of many rows and so without
// packets, is made that of these numbers. README.md in this folder, Eq. 13.
std::vector<int> told_numbers(const std::vector<double>& time_s, double& period_s);

}  // namespace odolab
