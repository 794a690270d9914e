// The capacities of planner, map and mission, once. Beyond one, input is refused by name; nothing grows.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ivo::limits {

// The planner's profile, chosen when the product is built (CMake option IVO_PLANNER_PROFILE).
struct Micro {
  static constexpr const char* kName = "micro";
  static constexpr int kNodes = 256;
  static constexpr int kAgents = 2;
  static constexpr int kCells = 65'536;
  static constexpr int kSightWords = 600'000;
  static constexpr int kSwaths = 30'000;
  static constexpr int kSightEvents = 350'000;
  static constexpr std::size_t kPlannerBytes = std::size_t{16} << 20U;
};
struct Onboard {
  static constexpr const char* kName = "onboard";
  static constexpr int kNodes = 4'096;
  static constexpr int kAgents = 4;
  static constexpr int kCells = 1'048'576;
  static constexpr int kSightWords = 7'400'000;
  static constexpr int kSwaths = 300'000;
  static constexpr int kSightEvents = 4'500'000;
  static constexpr std::size_t kPlannerBytes = std::size_t{256} << 20U;
};
struct Desktop {
  static constexpr const char* kName = "desktop";
  static constexpr int kNodes = 16'384;
  static constexpr int kAgents = 8;
  static constexpr int kCells = 4'194'304;
  static constexpr int kSightWords = 64'000'000;
  static constexpr int kSwaths = 2'600'000;
  static constexpr int kSightEvents = 48'000'000;
  static constexpr std::size_t kPlannerBytes = std::size_t{2048} << 20U;
};

#ifndef IVO_PLANNER_PROFILE
#define IVO_PLANNER_PROFILE Onboard
#endif
using Planner = IVO_PLANNER_PROFILE;

inline constexpr int kNodes = Planner::kNodes;
inline constexpr int kAgents = Planner::kAgents;
inline constexpr int kCells = Planner::kCells;
inline constexpr int kSightWords = Planner::kSightWords;    ///< rows of all swaths (planner/world/seen_map.hpp)
inline constexpr int kSwaths = Planner::kSwaths;            ///< of all nodes and edges
inline constexpr int kSightEvents = Planner::kSightEvents;  ///< cells first seen along an edge, of the edges kept ready
inline constexpr std::size_t kPlannerBytes = Planner::kPlannerBytes;  ///< at most: the planner object with all in it
inline constexpr int kEdges = kNodes * 56;     ///< directed edges: a 7x7 neighbourhood has 48, merged nodes more
inline constexpr int kNeighbours = 128;        ///< of one node; a graph that is built has no more (graph_build.cpp)
inline constexpr int kWaypoints = 2 * kNodes;  ///< of one agent's path: jumps may pass a node again

inline constexpr int kPolygonVertices = 64;  ///< of one preferred or restricted area
inline constexpr int kAreas = 16;            ///< preferred areas of one agent; restricted areas of one agent

inline constexpr std::size_t kFramesPerCycle = 256;  ///< taken from the bus in one cycle: 2 ms at 1 Mbit/s is 42 frames

static_assert(kCells <= 1 << 22 && kNodes <= 1 << 15);

}  // namespace ivo::limits
