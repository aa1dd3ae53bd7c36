// Independent pieces of work on all cores.
#pragma once

#include <atomic>
#include <functional>

#include "core/base/progress.h"

namespace odolab {

// Calls work(i, stopped) for every i below `count`, on as many threads as there are cores, and done(i) on the calling
// thread in the order of i, each as soon as it and all before it are finished. Results do not depend on the number of
// threads as long as work(i) touches only what belongs to i. Where `progress` says stop, no more work is handed out and
// `stopped` turns true, upon which long work should return early. Returns how many were done in order.
int parallel_for(int count, const std::function<void(int, const std::atomic<bool>& stopped)>& work,
                 const std::function<void(int)>& done = {}, const Progress& progress = {});

// The same for work that is too short to need stopping.
int parallel_for(int count, const std::function<void(int)>& work, const std::function<void(int)>& done = {},
                 const Progress& progress = {});

}  // namespace odolab
