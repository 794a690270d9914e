// The graph on which agents move (paper, "Problem Formulation"; model.md, "Graph"). Squares of side h from the
// lower-left corner; starts are nodes, first in order; a square's node is its centre, else the centroid of its free
// area, else a corner. Directed edges are kept row by row; each carries the agents that may use it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "config/base/static_vector.hpp"
#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/numeric/prefetch.hpp"
#include "planner/refusal.hpp"
#include "planner/world/polygon.hpp"
#include "planner/world/segmented_map.hpp"

namespace ivo::planner {

using Node = std::int32_t;
using Edge = std::int32_t;  ///< index of a directed edge
using AgentSet = std::uint8_t;

[[nodiscard]] constexpr AgentSet agent_bit(int agent) noexcept {
  return static_cast<AgentSet>(1U << static_cast<unsigned>(agent));
}
[[nodiscard]] constexpr bool in(AgentSet set, int agent) noexcept { return (set & agent_bit(agent)) != 0; }

struct GraphParameters {
  double spacing_m = 3.5;     ///< h
  double clearance_m = 0.40;  ///< node to nearest obstacle
};

struct GraphAgent {
  Point start;
  AgentKind kind = AgentKind::kRobot;
  double footprint_radius_m = 0.30;
  Areas restricted;
};
using GraphAgents = StaticVector<GraphAgent, limits::kAgents>;

struct GraphTable;

class Graph {
 public:
  /// Builds nodes and edges. Refuses a start outside the map, in or too near an obstacle, or restricted, and what is
  /// over a capacity. Cost: pixels for the nodes, then 24 swept-disc tests a node; heap-free.
  [[nodiscard]] Refusal build(const SegmentedMap& map, const GraphParameters& parameters,
                              const GraphAgents& agents) noexcept;
  /// Takes a graph that was built elsewhere for these agents. Refuses what is over a capacity, not a graph, or not
  /// theirs. Cost: the edges, each with a logarithm.
  [[nodiscard]] Refusal load(const GraphTable& table, const GraphAgents& agents) noexcept;
  /// This graph, for load(). Valid until the next build() or load().
  [[nodiscard]] GraphTable table() const noexcept;

  [[nodiscard]] int nodes() const noexcept { return nodes_; }
  [[nodiscard]] int edges() const noexcept { return first_edge_[static_cast<std::size_t>(nodes_)]; }
  [[nodiscard]] int agents() const noexcept { return agents_; }
  [[nodiscard]] double spacing_m() const noexcept { return spacing_m_; }
  /// Agent m starts at node m.
  [[nodiscard]] Point position(Node n) const noexcept { return positions_[index(n)]; }
  /// Agents that can get to this node from their start.
  [[nodiscard]] AgentSet reached_by(Node n) const noexcept { return reached_by_[index(n)]; }
  [[nodiscard]] int nodes_reached_by(int agent) const noexcept { return reached_count_[index(agent)]; }
  [[nodiscard]] int edges_open_to(int agent) const noexcept { return open_count_[index(agent)]; }

  [[nodiscard]] Edge first_edge(Node n) const noexcept { return first_edge_[index(n)]; }
  [[nodiscard]] Edge end_edge(Node n) const noexcept { return first_edge_[index(n) + 1]; }
  [[nodiscard]] Node head(Edge e) const noexcept { return heads_[index(e)]; }
  [[nodiscard]] double length_m(Edge e) const noexcept { return lengths_m_[index(e)]; }
  /// Agents that may use the edge and can get to it.
  [[nodiscard]] AgentSet open_to(Edge e) const noexcept { return open_to_[index(e)]; }
  /// Asks for what a choice among edges `first` to `first + count - 1` reads.
  void prefetch_choice(Edge first, int count) const noexcept {
    prefetch(heads_.data() + first, count);
    prefetch(open_to_.data() + first, count);
  }
  /// The edge from `a` to `b`, -1 when there is none. Cost: the logarithm of the node's edges.
  [[nodiscard]] Edge find(Node a, Node b) const noexcept;

 private:
  [[nodiscard]] Refusal place_starts(const SegmentedMap& map, const GraphAgents& agents) noexcept;
  [[nodiscard]] Refusal place_nodes(const SegmentedMap& map, const GraphParameters& parameters) noexcept;
  [[nodiscard]] Refusal connect(const SegmentedMap& map, const GraphAgents& agents) noexcept;
  void forget() noexcept;
  [[nodiscard]] bool is_whole() const noexcept;
  void reach() noexcept;
  [[nodiscard]] int square_of(Point p) const noexcept;
  [[nodiscard]] Node merge_target(Point p, int column, int row) const noexcept;
  int collect_neighbours(Node n) noexcept;
  void collect_window(int square, Node n) noexcept;

  static constexpr std::size_t kSquares = 2 * limits::kNodes;  // a square may hold no node
  static constexpr int kWindow = 3;                            // 7x7 squares
  static constexpr Node kNone = -1;

  int agents_ = 0;
  int nodes_ = 0;
  double spacing_m_ = 0.0;
  int columns_ = 0;  // of squares
  int rows_ = 0;
  std::array<Node, kSquares> square_node_{};          // the square's node, its own or the earlier one it points to
  std::array<std::int32_t, kSquares> next_square_{};  // of the same node
  std::array<std::int32_t, limits::kNodes> first_square_{};
  std::array<Point, limits::kNodes> positions_{};
  std::array<AgentSet, limits::kNodes> reached_by_{};
  std::array<std::int32_t, limits::kAgents> reached_count_{};
  std::array<std::int32_t, limits::kAgents> open_count_{};
  std::array<Edge, limits::kNodes + 1> first_edge_{};
  std::array<Node, limits::kEdges> heads_{};
  std::array<double, limits::kEdges> lengths_m_{};
  std::array<AgentSet, limits::kEdges> open_to_{};
  // While building: neighbours of one node, and the nodes a search has still to look at.
  std::array<Node, limits::kNodes> scratch_{};
  int scratch_size_ = 0;
  std::array<Node, limits::kNodes> marked_for_{};
};

}  // namespace ivo::planner
