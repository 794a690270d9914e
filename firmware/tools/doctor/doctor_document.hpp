// Findings as JSON, as config/schemas/doctor.schema.json says.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/latency_trial.hpp"

namespace ivo::firmware::doctor {

/// `run`: of the wake-ups, where they were measured.
[[nodiscard]] std::string doctor_json(const std::string& robot, std::span<const Group> groups,
                                      const std::optional<LatencyRun>& run);

}  // namespace ivo::firmware::doctor
