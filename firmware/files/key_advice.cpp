#include "firmware/files/key_advice.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace ivo::firmware {
namespace {

// Units that our files use, and those that people write instead.
constexpr std::array<std::pair<std::string_view, std::string_view>, 31> kUnits = {{
    {"m", "metres"},
    {"mps", "metres a second"},
    {"mps2", "metres a second squared"},
    {"rad", "radians"},
    {"deg", "degrees"},
    {"radps", "radians a second"},
    {"radps2", "radians a second squared"},
    {"s", "seconds"},
    {"bps", "bits a second"},
    {"px", "pixels"},
    {"mm", "millimetres"},
    {"cm", "centimetres"},
    {"km", "kilometres"},
    {"ft", "feet"},
    {"in", "inches"},
    {"ms", "milliseconds"},
    {"us", "microseconds"},
    {"min", "minutes"},
    {"h", "hours"},
    {"kmh", "kilometres an hour"},
    {"kph", "kilometres an hour"},
    {"mph", "miles an hour"},
    {"mmps", "millimetres a second"},
    {"cmps", "centimetres a second"},
    {"ms2", "metres a second squared"},
    {"degps", "degrees a second"},
    {"degps2", "degrees a second squared"},
    {"rps", "turns a second"},
    {"rpm", "turns a minute"},
    {"kbps", "kilobits a second"},
    {"mbps", "megabits a second"},
}};

std::string_view stem_of(std::string_view key) { return unit_of(key).empty() ? key : key.substr(0, key.rfind('_')); }

/// Least number of letters to insert, drop, change or swap with a neighbour.
std::size_t edits_between(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> cost((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return cost[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      const std::size_t change = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
      }
    }
  }
  return cost.back();
}

}  // namespace

std::string_view unit_of(std::string_view key) {
  const std::size_t underscore = key.rfind('_');
  if (underscore == std::string_view::npos || underscore == 0) {
    return {};
  }
  const std::string_view suffix = key.substr(underscore + 1);
  const auto* const unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& u) { return u.first == suffix; });
  return unit == kUnits.end() ? std::string_view{} : unit->second;
}

std::string advice_on_unknown_key(std::string_view key, const std::vector<std::string>& known) {
  for (const std::string& k : known) {
    if (!unit_of(k).empty() && stem_of(k) == stem_of(key)) {
      return "unknown; this quantity is given as " + k + ", in " + std::string(unit_of(k));
    }
  }
  const std::string* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, key.size() / 3) + 1;
  for (const std::string& k : known) {
    const std::size_t edits = edits_between(key, k);
    if (edits < least && edits < k.size()) {
      least = edits;
      nearest = &k;
    }
  }
  if (nearest != nullptr) {
    return "unknown; did you mean " + *nearest + "?";
  }
  std::string all;
  for (const std::string& k : known) {
    all += (all.empty() ? "" : ", ") + k;
  }
  return "unknown; expected " + (all.empty() ? "no key here" : "one of " + all);
}

}  // namespace ivo::firmware
