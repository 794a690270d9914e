#include "firmware/tools/profile/histogram_text.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

constexpr std::size_t kBarWidth = 40;
constexpr int kMostBars = 10;

// Of equal ratio, a part of an octave or whole octaves, so that few enough reach from `first` to `last`.
std::vector<Duration> edges_between(Duration first, Duration last) {
  double octaves = 0.125;
  const double span = std::log2(static_cast<double>(last.count()) / static_cast<double>(first.count()));
  while (span / octaves > kMostBars - 1) {
    octaves *= 2.0;
  }
  std::vector<Duration> edges;
  for (int i = 0; edges.empty() || edges.back() <= last; ++i) {
    edges.emplace_back(static_cast<Duration::rep>(static_cast<double>(first.count()) * std::exp2(octaves * i)));
  }
  return edges;
}

std::string line(const std::string& range, std::uint64_t count, std::uint64_t most) {
  const auto length = static_cast<std::size_t>(
      std::ceil(static_cast<double>(kBarWidth) * static_cast<double>(count) / static_cast<double>(most)));
  return format("  %-26s%s %s\n", range.c_str(), std::string(length, '#').c_str(), grouped(count).c_str());
}

}  // namespace

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) {
    at -= 3;
    text.insert(at, ",");
  }
  return text;
}

std::string histogram_text(const TimeHistogram& times) {
  if (times.count() == 0) {
    return {};
  }
  const Duration first = std::max(Duration(1), times.quantile(0.0));
  const std::vector<Duration> edges = edges_between(first, std::max(first, times.quantile(0.999)));
  std::vector<std::uint64_t> counts;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    // A bucket counts where it begins, which may be before its end, the fastest.
    counts.push_back(times.between(i == 0 ? Duration::zero() : edges[i], edges[i + 1]));
  }
  const std::uint64_t most = *std::max_element(counts.begin(), counts.end());
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    text += line(format("%9.1f to %9.1f us", microseconds(edges[i]), microseconds(edges[i + 1])), counts[i],
                 std::max<std::uint64_t>(1, most));
  }
  const std::uint64_t beyond = times.between(edges.back(), Duration::max());
  return beyond == 0
             ? text
             : text + line(format("%9.1f us and more", microseconds(edges.back())), beyond, std::max(most, beyond));
}

}  // namespace ivo::firmware
