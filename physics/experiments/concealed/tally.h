// Counts and shares, with how sure they are.
#pragma once

#include <string>

namespace odolab::concealed {

// How often something happened, of so many times.
struct Tally {
  int hits = 0, of = 0;
  void add(bool hit) { hits += hit ? 1 : 0, ++of; }
  double share() const { return of > 0 ? static_cast<double>(hits) / of : 0.0; }
  // E. B. Wilson 1927: the 95 % interval of the share behind it.
  double low() const;
  double high() const;
};

std::string text_of(const Tally& tally);             // "9 of 10"
std::string text_with_interval(const Tally& tally);  // "9 of 10 = 90 % (60 to 98)"
std::string percent_of(const Tally& tally);          // "90 %", empty without cases

}  // namespace odolab::concealed
