// What the console's clients are shown beside the status, as the documents that console_messages.hpp names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/console/area_board.hpp"
#include "firmware/loop/planner_slices.hpp"
#include "firmware/mission/searched_map.hpp"
#include "firmware/tools/dialogue/plan_notice.hpp"
#include "firmware/tools/plan_documents.hpp"

namespace ivo::firmware {

/// Name, map, cells, classes and agents.
[[nodiscard]] std::string mission_text(const PlanView& view);
/// A byte a pixel.
[[nodiscard]] std::string map_bytes(const MapFile& map);
/// Four bytes a cell.
[[nodiscard]] std::string probability_bytes(const planner::Planner& planner);
/// A bit a cell.
[[nodiscard]] std::string searched_bytes(const planner::Cells& cells, const planner::CellSet& searched);
/// Which areas a plan heeds.
struct PlanAreas {
  bool preferred = false;      ///< preferred ones too
  std::uint32_t revision = 0;  ///< of the board as it was then
};
[[nodiscard]] std::string plan_text(const PlanView& view, const ShownPlan& shown, const PlanAreas& areas);
/// With the share of the probability that each covers, of what anybody can observe. Cost: the cells of their extents
/// times their corners.
[[nodiscard]] std::string areas_text(const console::AreaBoard& board, const planner::Cells& cells,
                                     const SearchedMap& searched);
[[nodiscard]] std::string notice_text(const PlanNotice& notice, std::uint32_t number);

}  // namespace ivo::firmware
