#include "core/vehicle/key_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace odolab {

namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_unit(const std::string& word) {
  constexpr std::array<const char*, 5> kUnits = {"m", "rad", "s", "mps", "radps"};
  return std::find(kUnits.begin(), kUnits.end(), word) != kUnits.end();
}

std::vector<std::string> split(const std::string& key) {
  std::vector<std::string> words(1);
  for (char c : key)
    if (c == '_')
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

// Trucks are called by a letter.
std::string joined_with_letters(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : " ") + (word == "a" ? "A" : word == "b" ? "B" : word);
  return text;
}

}  // namespace

std::string with_blanks(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

std::string part_words(const std::string& part) {
  std::string spaced;
  for (char c : part) {
    if (c == '[' || c == ']') continue;
    if (is_digit(c) && !spaced.empty() && !is_digit(spaced.back()) && spaced.back() != '_') spaced += '_';
    spaced += c;
  }
  return joined_with_letters(split(spaced));
}

std::string component_words(const std::string& component) {
  const std::size_t dot = component.find('.');
  if (dot != std::string::npos)
    return component_words(component.substr(dot + 1)) + " of " + part_words(component.substr(0, dot));
  if (component.rfind("both", 0) == 0 || component.rfind("truck", 0) == 0 || component.rfind("castor", 0) == 0)
    return part_words(component);
  return "the " + part_words(component);
}

std::string parameter_words(const std::string& key) {
  if (const std::size_t dot = key.find('.'); dot != std::string::npos)
    return part_words(key.substr(0, dot)) + ", " + parameter_words(key.substr(dot + 1));
  std::vector<std::string> words = split(key);
  std::string number;  // of several that are alike: "phase_rad_2"
  if (words.size() > 1 && !words.back().empty() && std::all_of(words.back().begin(), words.back().end(), is_digit)) {
    number = words.back();
    words.pop_back();
  }
  const auto per = std::find(words.begin(), words.end(), "per");
  if (per == words.begin() || (per != words.end() && is_unit(*(per - 1))))
    words.erase(per == words.begin() ? per : per - 1, words.end());
  else if (words.size() > 1 && is_unit(words.back()))
    words.pop_back();
  if (words.empty()) words.push_back("amount");
  if (!number.empty()) words.push_back(number);
  return joined_with_letters(words);
}

std::string effect_words(const std::string& effect) {
  if (effect == "one_sided_drag") return "one-sided drag";
  if (effect == "speed_dependent_radius") return "speed-dependent radius";
  return with_blanks(effect);
}

}  // namespace odolab
