// Why the planner will not plan. A code and the numbers of the case; the sentence is made where text is allowed
// (firmware/tools/planner_setup.hpp).
#pragma once

#include <cstdint>

namespace ivo::planner {

enum class RefusalCode : std::uint8_t {
  kNone,
  kTooManyCells,      ///< value cells, limit
  kTooManySquares,    ///< value squares of the graph, limit
  kTooManyNodes,      ///< value nodes, limit
  kTooManyEdges,      ///< value directed edges so far, limit
  kSightTableFull,    ///< value events so far, limit
  kEdgeTooLong,       ///< value sight points of one edge, limit: cells too small for the spacing
  kNoGraphTable,      ///< this build has no libccd and must be given its graph
  kGraphTableUnfit,   ///< a graph that was given is none, or not one for these agents
  kStartOutsideMap,   ///< agent
  kStartBlocked,      ///< agent; value metres to the nearest obstacle or border, limit its footprint's radius
  kStartRestricted,   ///< agent
  kPriorWithoutMass,  ///< no free cell holds any
  kNoMassObservable,  ///< agent; from everywhere it can go it sees no cell that holds any
  kAreaWithoutMass,   ///< agent, area; a preferred area covers no mass that its agent can observe
};

struct Refusal {
  RefusalCode code = RefusalCode::kNone;
  int agent = -1;
  int area = -1;
  double value = 0.0;
  double limit = 0.0;

  [[nodiscard]] explicit operator bool() const noexcept { return code != RefusalCode::kNone; }
};

}  // namespace ivo::planner
