// What a search problem must be before anything is built from it. Whoever made it, file reader or other program, is not
// trusted.
#pragma once

#include <cstdint>

#include "planner/refusal.hpp"

namespace ivo::planner {

struct SearchProblem;

/// Refusal::area of kColonyInvalid.
enum class ColonyParameterNumber : std::uint8_t {
  kGenerations,    ///< at least 1
  kAnts,           ///< at least 1
  kBeta,           ///< 0 to 12
  kRho,            ///< above 0, at most 1
  kIterationBest,  ///< 0 to 1
  kShortestFirst,  ///< 0 to 1
  kMaxUnseenMass,  ///< 0 to 1
};

/// Below it a long path's time overflows.
inline constexpr double kLeastSpeed_mps = 1e-4;
/// Of a sight radius, in cells.
inline constexpr double kMostSightCells = 1e8;
inline constexpr double kLeastSigma_m = 1e-6;
inline constexpr double kMostSpacing_m = 1e9;

/// The first fault: of the map, the sizes, the colony, the agents in order, the prior, the sub-priors. Starts are for
/// Graph::build, capacities for who fills them. Cost: agents, vertices and components.
[[nodiscard]] Refusal check(const SearchProblem& problem) noexcept;

}  // namespace ivo::planner
