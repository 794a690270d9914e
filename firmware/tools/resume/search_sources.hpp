// The files that a search is made of: mission, map and its picture, classes, robot and its drives' EDS files, prior and
// sub-priors.
#pragma once

#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/resume/kept_search.hpp"

namespace ivo::firmware {

/// Reads them once more, whole, and takes their fingerprints (FNV-1a, 64 bits: against changes, not against malice).
[[nodiscard]] Result<std::vector<KeptSource>> search_sources(const MissionInputs& inputs);

/// The path of the first file that is not as it was; empty when all are. Where a file lies does not matter, what is in
/// it does.
[[nodiscard]] std::string changed_source(const std::vector<KeptSource>& kept, const std::vector<KeptSource>& now);

}  // namespace ivo::firmware
