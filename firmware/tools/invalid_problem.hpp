// Sentences for search problems that the planner refuses before it builds anything (problem_checks.hpp). The readers of
// mission and robot files refuse most of these first, in their own words.
#pragma once

#include "config/base/result.hpp"
#include "firmware/files/lines.hpp"
#include "planner/refusal.hpp"

namespace ivo::firmware {

/// FILE:LINE: KEY: what was wrong; what is expected.
[[nodiscard]] Error invalid_problem(const planner::Refusal& refusal, const Lines& lines);

}  // namespace ivo::firmware
