// Figures and histogram of wake-ups.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/latency_trial.hpp"

namespace ivo::firmware::doctor {

/// A wake-up may be so late: a tenth of the cycle is nobody's work.
[[nodiscard]] constexpr Duration wake_up_budget(Duration cycle) noexcept { return cycle / 10; }

struct LatencyFigures {
  Duration least{}, median{}, p99{}, p999{}, most{};
  Duration budget{};
  std::uint64_t over_budget = 0;
};
[[nodiscard]] LatencyFigures figures_of(const LatencyRun& run);

/// Nearest rank of sorted values, at least one; `share` from 0 to 1.
[[nodiscard]] Duration percentile(std::span<const Duration> sorted, double share);

struct Bin {
  std::int64_t from_us = 0;
  std::int64_t to_us = 0;  ///< not within
  std::uint64_t count = 0;
};
/// From the bin of the first of `sorted` to that of the last, empty ones between them too: at most about 20, about as
/// wide as a fifth of where they are, or a half.
[[nodiscard]] std::vector<Bin> histogram_of(std::span<const Duration> sorted);

/// "a SCHED_FIFO thread, priority 80, on CPU 3, with locked memory"
[[nodiscard]] std::string thread_text(const LatencyRun& run);

[[nodiscard]] Group latency_checks(const LatencyRun& run);
/// A line a bin; a bar as long as its count has digits, so that one wake-up among thousands is seen.
[[nodiscard]] std::vector<std::string> histogram_lines(const LatencyRun& run);

}  // namespace ivo::firmware::doctor
