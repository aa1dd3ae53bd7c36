// Independent pieces of work on all cores.
#pragma once

#include <functional>

#include "core/base/progress.h"

namespace odolab {

// Calls work(i) for every i below `count`, on as many threads as there are cores, and done(i) on the calling thread in
// the order of i, each as soon as it and all before it are finished. Results do not depend on the number of threads as
// long as work(i) touches only what belongs to i. Stops handing out work where `progress` says so; returns how many were
// done in order.
int parallel_for(int count, const std::function<void(int)>& work, const std::function<void(int)>& done = {},
                 const Progress& progress = {});

}  // namespace odolab
