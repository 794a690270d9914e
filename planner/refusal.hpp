// Why the planner will not plan. A code and the numbers of the case; the sentence is made where text is allowed
// (firmware/tools/planner_setup.hpp).
#pragma once

#include <cstdint>

namespace ivo::planner {

enum class RefusalCode : std::uint8_t {
  kNone,
  kTooManyCells,       ///< value cells, limit; a row of under 64 takes the room of up to 60
  kTooManySquares,     ///< value squares of the graph, limit
  kTooManyNodes,       ///< value nodes that there would be, at most, limit
  kTooManyEdges,       ///< value directed edges so far, limit
  kTooManyNeighbours,  ///< value edges from one node of a graph that was given, limit
  kSightTableFull,     ///< value rows of all swaths, limit (the count ends above the largest profile's)
  kTooManySwaths,      ///< value swaths of all nodes and edges, limit (likewise)
  kEdgeTooLong,        ///< value sight points of one edge, limit: cells too small for the spacing
  kNoGraphTable,       ///< this build has no libccd and must be given its graph
  kGraphTableUnfit,    ///< a graph that was given is none, or not one for these agents
  kStartOutsideMap,    ///< agent
  kStartBlocked,       ///< agent; value metres to the nearest obstacle or border, limit its footprint's radius
  kStartRestricted,    ///< agent
  kPriorWithoutMass,   ///< no free cell holds any
  kNoMassObservable,   ///< agent; from everywhere it can go it sees no cell that holds any
  kAreaWithoutMass,    ///< agent, area; a preferred area covers no mass that its agent can observe
  kPriorNotFinite,     ///< value, a mass below 0, infinite or no number; agent: of its sub-prior, -1: of the prior
  // What problem_checks.hpp finds, before anything is built.
  kMapInvalid,         ///< value pixels given, limit width times height; or limit 0: value metres a pixel
  kNoAgents,           ///< nobody to search
  kCellSizeInvalid,    ///< value metres
  kSpacingInvalid,     ///< value metres, limit the most
  kClearanceInvalid,   ///< value metres
  kSpeedInvalid,       ///< agent; value metres a second, limit the least there is
  kSightInvalid,       ///< agent; value metres, limit the most there is
  kFootprintInvalid,   ///< agent; value metres
  kAreaInvalid,        ///< agent, area; value 0 preferred, 1 restricted: under 3 vertices, or one that is not finite
  kGaussianInvalid,    ///< area: which component; mean not finite, sigma_m under 1e-6 m or weight below 0
  kImageInvalid,       ///< agent: of its sub-prior, -1: of the prior; value pixels given, limit width times height
  kColonyInvalid,      ///< area: which parameter, in the order of ColonyParameterNumber; value
  kSubPriorsTwice,     ///< agent; sub-priors are given, and it has preferred areas too
  kSubPriorsMismatch,  ///< value sub-priors or components given, limit as many as there must be
  kComponentDealtToNobody,  ///< area: which component; value the agent it is dealt to, limit how many there are
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
