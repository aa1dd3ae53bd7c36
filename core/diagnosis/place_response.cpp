#include "core/diagnosis/place_response.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/mismatch.h"

namespace odolab {

namespace {

constexpr int kStrips = 16;
constexpr int kFewestInAStrip = 20;  // samples of a strip
constexpr double kLeastRoom_m = 0.2;

using Values = std::vector<double> Residuals::*;
using Size = double ResidualSizes::*;

struct Range {
  double low = 1e300, high = -1e300;
  std::size_t strip(double v) const {
    return static_cast<std::size_t>(std::clamp(static_cast<int>((v - low) / (high - low) * kStrips), 0, kStrips - 1));
  }
};

struct Strip {
  double sum = 0.0;  // of what is white and of size 1 where nothing but noise is left
  int samples = 0;
  double times_noise() const { return samples > 0 ? sum / std::sqrt(static_cast<double>(samples)) : 0.0; }
};

std::vector<Strip> summed(const std::vector<Residuals>& all, Values place, Values value, Size size,
                          const std::vector<ResidualSizes>& noise, const Range& range) {
  std::vector<Strip> strips(kStrips);
  for (std::size_t r = 0; r < all.size(); ++r) {
    const double one = r < noise.size() ? noise[r].*size : 0.0;
    if (!(one > 0.0)) continue;  // a truth without headings has no turns
    for (std::size_t i = 0; i < all[r].time_s.size(); ++i) {
      const double v = (all[r].*value)[i];
      if (!std::isfinite(v)) continue;
      Strip& s = strips[range.strip((all[r].*place)[i])];
      s.sum += v / one;
      ++s.samples;
    }
  }
  return strips;
}

}  // namespace

std::vector<Response> place_responses(const std::vector<Residuals>& before, const std::vector<Residuals>& after,
                                      bool found) {
  struct Axis {
    const char* name;
    Values place;
  };
  struct Channel {
    const char* name;
    Values value;
    Size size;
  };
  const Axis axes[] = {{"place, x [m]", &Residuals::x_m}, {"place, y [m]", &Residuals::y_m}};
  const Channel channels[] = {{"turn [times the noise]", &Residuals::heading_rad, &ResidualSizes::heading_rad},
                              {"forward [times the noise]", &Residuals::along_m, &ResidualSizes::along_m},
                              {"sideways [times the noise]", &Residuals::across_m, &ResidualSizes::across_m}};
  std::vector<ResidualSizes> noise;
  for (const Residuals& r : found&& after.size() == before.size() ? after : before) noise.push_back(sizes_of(r));
  std::vector<Response> all;
  for (const Channel& channel : channels)
    for (const Axis& axis : axes) {
      Range range;
      for (const Residuals& r : before)
        for (double v : r.*axis.place) {
          range.low = std::min(range.low, v);
          range.high = std::max(range.high, v);
        }
      if (!(range.high - range.low >= kLeastRoom_m)) continue;
      const std::vector<Strip> strips = summed(before, axis.place, channel.value, channel.size, noise, range);
      const std::vector<Strip> left = summed(after, axis.place, channel.value, channel.size, noise, range);
      Response response;
      response.variable = axis.name;
      response.channel = channel.name;
      for (std::size_t k = 0; k < kStrips; ++k) {
        if (strips[k].samples < kFewestInAStrip) continue;
        const double value = strips[k].times_noise();
        response.at.push_back(range.low + (static_cast<double>(k) + 0.5) * (range.high - range.low) / kStrips);
        response.value.push_back(value);
        response.low.push_back(value - 2.0);
        response.high.push_back(value + 2.0);
        if (found) response.after.push_back(left[k].times_noise());
      }
      if (response.at.size() > 1) all.push_back(std::move(response));
    }
  return all;
}

Response zone_response(const WhereFound::Zone& zone, const std::string& name, const std::vector<Residuals>& before,
                       const std::vector<Residuals>& after) {
  constexpr double kRadii = 3.0, kLeast_m = 0.6;
  constexpr double kGathered_s = 1.0;  // so long apart two mismatches have nothing in common
  const Range range{0.0, std::max(kLeast_m, kRadii * zone.radius_m)};
  struct Ring {
    double sum = 0.0, squares = 0.0, seconds = 0.0;
    int samples = 0;
    double mean() const { return sum / samples; }
  };
  const bool has_after = after.size() == before.size();
  const auto rings = [&](const std::vector<Residuals>& all) {
    std::vector<Ring> of_place(kStrips);
    for (std::size_t r = 0; r < all.size(); ++r) {
      const std::vector<double> mismatch = times_noise(all[r], sizes_of(has_after ? after[r] : before[r]));
      for (std::size_t i = 0; i < mismatch.size(); ++i) {
        const double away_m = std::hypot(all[r].x_m[i] - zone.x_m, all[r].y_m[i] - zone.y_m);
        if (away_m >= range.high || !std::isfinite(mismatch[i])) continue;
        Ring& ring = of_place[range.strip(away_m)];
        ring.sum += mismatch[i];
        ring.squares += mismatch[i] * mismatch[i];
        if (i > 0) ring.seconds += std::min(kGathered_s, all[r].time_s[i] - all[r].time_s[i - 1]);
        ++ring.samples;
      }
    }
    return of_place;
  };
  const std::vector<Ring> found = rings(before), left = has_after ? rings(after) : found;
  Response response;
  response.variable = "distance from the " + name + " [m]";
  response.channel = kMismatchAboutPlace;
  for (std::size_t k = 0; k < kStrips; ++k) {
    const Ring& ring = found[k];
    if (ring.samples < kFewestInAStrip || (has_after && left[k].samples == 0)) continue;
    const double variance = std::max(0.0, ring.squares / ring.samples - ring.mean() * ring.mean());
    const double band = 2.0 * std::sqrt(variance / std::max(1.0, ring.seconds / kGathered_s));
    response.at.push_back((static_cast<double>(k) + 0.5) * range.high / kStrips);
    response.value.push_back(ring.mean());
    response.low.push_back(ring.mean() - band);
    response.high.push_back(ring.mean() + band);
    if (has_after) response.after.push_back(left[k].mean());
  }
  if (response.at.size() < 2) response = {};
  return response;
}

}  // namespace odolab
