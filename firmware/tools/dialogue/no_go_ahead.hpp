// Does a plan lead somebody into an area that was closed after it was made?
#pragma once

#include <cstdint>

#include "firmware/console/area_board.hpp"
#include "planner/search/plan.hpp"

namespace ivo::firmware {

/// The last `left_m` of the path touch a no-go area of `agent` or of everybody. A path that was planned around an area
/// never touches it. Cost: the path's legs times the areas' corners.
[[nodiscard]] bool leads_into_no_go(const planner::AgentPath& path, double left_m, const console::AreaBoard& board,
                                    std::uint8_t agent);

}  // namespace ivo::firmware
