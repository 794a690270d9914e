// Findings in lines for a person.
#pragma once

#include <span>
#include <string>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/latency_trial.hpp"

namespace ivo::firmware::doctor {

[[nodiscard]] const char* name_of(State state) noexcept;  ///< "ok", "warning", "fault", "not checked"

/// Name, then a line a finding and, below it, one for its remedy. `coloured`: with a terminal's colours.
[[nodiscard]] std::string group_text(const Group& group, bool coloured);
/// The histogram with what it is of.
[[nodiscard]] std::string latency_text(const LatencyRun& run);

struct Sum {
  int ok = 0, warnings = 0, faults = 0, not_checked = 0;
};
[[nodiscard]] Sum sum_of(std::span<const Group> groups);
[[nodiscard]] std::string sum_text(const Sum& sum, bool coloured);

}  // namespace ivo::firmware::doctor
