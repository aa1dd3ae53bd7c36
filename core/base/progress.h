// How long work reports how far it is and learns that it should stop.
#pragma once

#include <functional>

namespace odolab {

// Called now and then with the share done, 0 to 1; returns false where the work should stop. May be empty.
using Progress = std::function<bool(double share_done)>;

inline bool goes_on(const Progress& progress, double share_done) { return !progress || progress(share_done); }

}  // namespace odolab
