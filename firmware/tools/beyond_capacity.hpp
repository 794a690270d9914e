// Sentences for missions that are too large for this build's planner, with the profile that would fit.
#pragma once

#include <optional>

#include "config/base/result.hpp"
#include "firmware/files/lines.hpp"
#include "planner/refusal.hpp"

namespace ivo::firmware {

/// FILE:LINE: KEY: what is too many; what is expected; which profile fits. Nothing for any other refusal.
[[nodiscard]] std::optional<Error> beyond_capacity(const planner::Refusal& refusal, const Lines& lines);

}  // namespace ivo::firmware
