#include "core/io/import/sample_spool.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "core/geometry/angles.h"

namespace odolab {

namespace {

constexpr std::size_t kWindow = 1024;                    // samples that one may come late by
constexpr std::int64_t kLatestSum_ns = (1ll << 62) - 1;  // so that sums and differences of two stamps fit
constexpr std::size_t kKeptNumbers = 1 << 17;            // a megabyte

double bits_of(std::int64_t time_ns) {
  double bits;
  std::memcpy(&bits, &time_ns, sizeof bits);
  return bits;
}
std::int64_t time_of(double bits) {
  std::int64_t time_ns;
  std::memcpy(&time_ns, &bits, sizeof time_ns);
  return time_ns;
}

// A file that is gone as soon as it is closed.
std::FILE* nameless_file(const std::string& folder) {
  std::string name = (folder.empty() ? std::string(".") : folder) + "/.odolab-XXXXXX";
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) return nullptr;
  ::unlink(name.c_str());
  std::FILE* file = ::fdopen(descriptor, "w+b");
  if (!file) ::close(descriptor);
  return file;
}

}  // namespace

SampleSpool::SampleSpool(std::vector<std::string> channels, std::string spill_folder)
    : channels_(std::move(channels)), spill_folder_(std::move(spill_folder)), angles_(channels_.size()) {}

void SampleSpool::add(std::int64_t time_ns, const double* values) {
  if (time_ns > kLatestSum_ns || time_ns < -kLatestSum_ns) {
    ++beyond_;
    return;
  }
  std::size_t row = order_.size();
  if (order_.size() == kWindow) {
    row = order_.front();
    // the oldest leaves, unless the new one is older still
    if (time_ns < pending_ns_[row]) {
      if (samples_ > 0 && time_ns < last_ns_) {
        ++late_;
      } else {
        keep(time_ns, values);
      }
      return;
    }
    keep(pending_ns_[row], pending_.data() + row * channels_.size());
    order_.pop_front();
  } else {
    pending_.resize((row + 1) * channels_.size());
    pending_ns_.resize(row + 1);
  }
  std::copy(values, values + channels_.size(), pending_.begin() + static_cast<std::ptrdiff_t>(row * channels_.size()));
  pending_ns_[row] = time_ns;
  order_.push_back(row);
  for (std::size_t i = order_.size() - 1; i > 0 && pending_ns_[order_[i - 1]] > time_ns; --i)
    std::swap(order_[i - 1], order_[i]);
}

void SampleSpool::keep(std::int64_t time_ns, const double* values) {
  if (samples_ == 0) first_ns_ = time_ns;
  last_ns_ = time_ns;
  ++samples_;
  for (std::size_t c = 0; c < angles_.size(); ++c) {
    Angle& angle = angles_[c];
    if (!angle.asked || std::isnan(values[c])) continue;
    if (angle.any && std::abs(values[c] - angle.previous) > kPi) angle.jumps = true;
    angle.lowest = angle.any ? std::min(angle.lowest, values[c]) : values[c];
    angle.highest = angle.any ? std::max(angle.highest, values[c]) : values[c];
    angle.previous = values[c];
    angle.any = true;
  }
  kept_.push_back(bits_of(time_ns));
  kept_.insert(kept_.end(), values, values + channels_.size());
  if (!spill_folder_.empty() && kept_.size() >= kKeptNumbers) spill();
}

void SampleSpool::spill() {
  if (!failure_.empty()) {
    kept_.clear();
    return;
  }
  if (!file_) file_.reset(nameless_file(spill_folder_));
  if (!file_ || std::fwrite(kept_.data(), sizeof(double), kept_.size(), file_.get()) != kept_.size())
    failure_ = std::strerror(errno);
  kept_.clear();
}

Result<Done> SampleSpool::finish() {
  for (std::size_t row : order_) keep(pending_ns_[row], pending_.data() + row * channels_.size());
  order_.clear();
  pending_.clear();
  if (file_) {
    spill();
    if (failure_.empty() && std::fflush(file_.get()) != 0) failure_ = std::strerror(errno);
    std::rewind(file_.get());
  }
  if (!failure_.empty()) return Error{spill_folder_, failure_, "a folder with room for the samples"};
  for (Angle& angle : angles_) angle.any = false;
  return Done{};
}

bool SampleSpool::wraps(std::size_t channel) const {
  const Angle& angle = angles_[channel];
  const double span = angle.highest - angle.lowest;
  constexpr double kMostOfATurn = 1.5 * kPi;  // which an angle has seen that comes by its end
  return angle.asked && angle.jumps && span >= kMostOfATurn && span <= 2.0 * kPi + 1e-3;
}

bool SampleSpool::refill() {
  if (!file_) return false;
  kept_.resize(kKeptNumbers / width() * width());
  const std::size_t n = std::fread(kept_.data(), sizeof(double), kept_.size(), file_.get());
  kept_.resize(n / width() * width());
  reading_ = 0;
  return !kept_.empty();
}

bool SampleSpool::next(std::int64_t& time_ns, double* values) {
  if (reading_ >= kept_.size() && !refill()) return false;
  time_ns = time_of(kept_[reading_]) + shift_ns_;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    values[c] = kept_[reading_ + 1 + c];
    if (std::isnan(values[c]) || !wraps(c)) continue;
    Angle& angle = angles_[c];
    if (angle.any) angle.turns -= std::round((values[c] - angle.previous) / (2.0 * kPi));
    angle.previous = values[c];
    angle.any = true;
    values[c] += 2.0 * kPi * angle.turns;
  }
  reading_ += width();
  return true;
}

}  // namespace odolab
