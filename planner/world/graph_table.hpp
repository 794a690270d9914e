// A graph as flat constant arrays: what a machine without libccd searches on. It is built where libccd is, written as a
// source, and linked in (tests/cross/graph_tables_main.cpp).
#pragma once

#include <span>

#include "planner/world/graph.hpp"

namespace ivo::planner {

/// A view: the arrays belong to who made them. What else a graph knows follows from these.
struct GraphTable {
  double spacing_m = 0.0;  ///< h
  int agents = 0;
  std::span<const Point> positions;   ///< one a node; agent m starts at node m
  std::span<const Edge> first_edge;   ///< one a node, then the number of edges
  std::span<const Node> heads;        ///< one an edge; those of a node ascend; every edge has its way back
  std::span<const AgentSet> open_to;  ///< one an edge
};

}  // namespace ivo::planner
