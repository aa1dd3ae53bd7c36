// Columns that betray by themselves that they are not what they are taken for. An Error stands at the column.
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/recording/recording.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

// Rows so far apart that a drive could not be followed by them, if their stamps were seconds: an Error that says which
// unit they look like. Of twenty rows and more.
std::optional<Error> stamps_in_no_seconds(const Recording& recording);

// A counter that jumps by a power of two and goes on at its pace where the vehicle's file knows of none that wraps: an
// Error that says how many bits it looks like.
std::optional<Error> unknown_wrap(const Recording& recording, const DifferentialDrive& drive);

}  // namespace odolab
