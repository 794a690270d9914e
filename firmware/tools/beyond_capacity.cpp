#include "firmware/tools/beyond_capacity.hpp"

#include <cmath>
#include <string>

#include "config/limits.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/planner_capacity.hpp"

namespace ivo::firmware {
namespace {

using limits::Desktop;
using limits::Micro;
using limits::Onboard;

constexpr Capacity kCells = {Micro::kCells, Onboard::kCells, Desktop::kCells};
constexpr Capacity kNodes = {Micro::kNodes, Onboard::kNodes, Desktop::kNodes};
constexpr Capacity kWords = {Micro::kSightWords, Onboard::kSightWords, Desktop::kSightWords};
constexpr Capacity kSwaths = {Micro::kSwaths, Onboard::kSwaths, Desktop::kSwaths};

// Of what each profile has so many a node.
constexpr Capacity a_node(double many) { return {many * kNodes.micro, many * kNodes.onboard, many * kNodes.desktop}; }

constexpr double kSquaresANode = 2;
constexpr double kEdgesANode = static_cast<double>(limits::kEdges) / limits::kNodes;

std::string whole(double value) { return shortest(std::trunc(value)); }

}  // namespace

std::optional<Error> beyond_capacity(const planner::Refusal& refusal, const Lines& lines) {
  using planner::RefusalCode;
  const std::string counts = whole(refusal.value) + ", more than this build's " + whole(refusal.limit);
  const auto sentence = [&](const char* key, const std::string& what, const char* expected, const Capacity& capacity) {
    return lines.at(key, what + "; expected " + expected + "; " + profile_that_fits(refusal.value, capacity));
  };
  switch (refusal.code) {
    case RefusalCode::kTooManyCells:
      return sentence("planner.cell_m", "the map has too many cells: " + counts, "a larger cell_m", kCells);
    case RefusalCode::kTooManySquares:
      return sentence("planner.spacing_m", "the graph has too many squares: " + counts, "a larger spacing_m",
                      a_node(kSquaresANode));
    case RefusalCode::kTooManyNodes:
      return sentence("planner.spacing_m", "the graph has too many nodes: " + counts, "a larger spacing_m", kNodes);
    case RefusalCode::kTooManyEdges:
      return sentence("planner.spacing_m", "the graph has too many edges: " + counts, "a larger spacing_m",
                      a_node(kEdgesANode));
    case RefusalCode::kSightTableFull:
      return sentence("planner.cell_m", "the sight table has too many rows: " + counts,
                      "a larger cell_m or spacing_m, or a smaller sight_radius_m", kWords);
    case RefusalCode::kTooManySwaths:
      return sentence("planner.cell_m", "the sight table has too many swaths: " + counts,
                      "a larger cell_m or spacing_m", kSwaths);
    case RefusalCode::kEdgeTooLong:  // in every profile
      return lines.at("planner.cell_m",
                      "an edge has " + whole(refusal.value) + " sight points, more than " + whole(refusal.limit) +
                          "; expected a larger cell_m or a smaller spacing_m; " + profile_that_fits(refusal.value, {}));
    default:
      return std::nullopt;
  }
}

}  // namespace ivo::firmware
