// Seeded random numbers that are the same on every machine and compiler; the standard library's distributions are not.
#pragma once

#include <cstdint>

namespace odolab {

// A well-mixed 64-bit hash of a counter (SplitMix64; Steele, Lea, Flood 2014). Equal inputs give equal outputs.
std::uint64_t mixed(std::uint64_t value);

// The seed of an independent stream, e.g. of run 3 of a benchmark or of the left wheel's floor.
std::uint64_t seed_of_stream(std::uint64_t seed, std::uint64_t stream);

// Uniform in [0, 1) from a hash: 53 random bits.
double uniform_from_hash(std::uint64_t hash);

// xoshiro256++ (Blackman, Vigna 2019), seeded through SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed);
  std::uint64_t next();
  double uniform();                         // [0, 1)
  double uniform(double low, double high);  // [low, high)
  double normal();                          // mean 0, standard deviation 1 (Box and Muller 1958)

 private:
  std::uint64_t state_[4];
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace odolab
