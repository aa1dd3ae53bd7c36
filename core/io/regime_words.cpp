#include "core/io/regime_words.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace odolab {

namespace {

using Words = std::pair<std::string_view, std::string_view>;

// In place of the whole of what is before, and behind, " that depends on ".
constexpr Words kOfChannels[] = {
    {"forward per metre", "how far it goes for each metre that its wheels roll"},
    {"sideways per metre", "how far it goes sideways for each metre"},
    {"turn per metre", "how far it turns for each metre"},
    {"turn per turn", "how far it turns for each turn that its wheels make"},
    {"turn per metre forwards", "how far it turns for each metre forwards, and back in reverse"},
    {"forward, sideways and turn, per metre", "its way forward, sideways and round, for each metre"},
    {"left wheel per metre", "how far the left wheel goes for each metre that it rolls"},
    {"right wheel per metre", "how far the right wheel goes for each metre that it rolls"},
};
constexpr Words kOfVariables[] = {
    {"turn before, forgotten over metres", "how it turned over the last metres"},
    {"time since the start, forgotten over seconds", "the time since the start, for some seconds"},
    {"way since it stood", "how far it went since it stood"},
    {"way since it reversed", "how far it went since it reversed"},
    {"place on the floor", "where on the floor it is"},
    {"recording", "the recording"},
    {"time", "the time"},
    {"heading", "its heading"},
    {"speed", "its speed"},
    {"yaw rate", "its yaw rate"},
};

template <std::size_t kCount>
std::string in_other_words(const std::string& text, const Words (&words)[kCount]) {
  for (const auto& [from, to] : words)
    if (text == from) return std::string(to);
  return text;
}

std::string without_units(std::string text) {
  for (std::size_t from = text.find(" ["); from != std::string::npos; from = text.find(" [", from)) {
    const std::size_t to = text.find(']', from);
    if (to == std::string::npos) break;
    text.erase(from, to + 1 - from);
  }
  return text;
}

}  // namespace

std::string regime_in_words(std::string regime) {
  constexpr std::string_view kDependsOn = " that depends on ";
  regime = without_units(std::move(regime));
  const std::size_t at = regime.find(kDependsOn);
  if (at == std::string::npos) return regime;
  const std::string behind = regime.substr(at + kDependsOn.size());
  const std::size_t variable = std::min(behind.find(" ("), behind.size());  // what is said of it stands behind it
  return in_other_words(regime.substr(0, at), kOfChannels) + ", depending on " +
         in_other_words(behind.substr(0, variable), kOfVariables) + behind.substr(variable);
}

}  // namespace odolab
