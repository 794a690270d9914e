// What is first seen where along each edge, prepared so that a planner's move costs a table look-up and no ray.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/refusal.hpp"
#include "planner/world/cells.hpp"
#include "planner/world/graph.hpp"

namespace ivo::planner {

/// A cell and the sight point (visibility.hpp) at which it is first seen, packed in four bytes.
class SightEvent {
 public:
  static constexpr int kCellBits = std::bit_width(static_cast<unsigned>(limits::kCells - 1));
  static constexpr int kMaxPoint = (1 << (32 - kCellBits)) - 1;

  SightEvent() = default;
  constexpr SightEvent(Cell cell, int point) noexcept
      : bits_(static_cast<std::uint32_t>(point) << kCellBits | static_cast<std::uint32_t>(cell)) {}
  [[nodiscard]] constexpr Cell cell() const noexcept { return static_cast<Cell>(bits_ & ((1U << kCellBits) - 1)); }
  [[nodiscard]] constexpr int point() const noexcept { return static_cast<int>(bits_ >> kCellBits); }

 private:
  std::uint32_t bits_ = 0;
};

/// Sensing radius of each agent, R_m.
using SightRadii = std::array<double, limits::kAgents>;

class SightTable {
 public:
  /// Agents of one radius share their rows. Only cells with `mass` above 0 are kept. Cost: each edge's sight points
  /// times the disc.
  [[nodiscard]] Refusal build(const Cells& cells, const Graph& graph, const SightRadii& radii_m,
                              std::span<const double> mass) noexcept;

  /// Cells with mass seen from a node; all at point 0.
  [[nodiscard]] std::span<const SightEvent> from_node(int agent, Node n) const noexcept;
  /// Cells with mass seen along an edge and not from its tail; a cell once, at the first point that sees it.
  [[nodiscard]] std::span<const SightEvent> along_edge(int agent, Edge e) const noexcept;
  /// n of visibility.hpp: the edge's last sight point.
  [[nodiscard]] int points(Edge e) const noexcept { return points_[static_cast<std::size_t>(e)]; }
  /// Agents that can see the cell from a node or an edge that they can get to.
  [[nodiscard]] AgentSet observable_by(Cell c) const noexcept { return observable_by_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] int events() const noexcept { return events_; }

 private:
  struct Rows {
    std::int32_t first = 0;
    std::int32_t count = 0;
  };
  using EdgeRows = std::array<Rows, limits::kEdges>;
  using NodeRows = std::array<Rows, limits::kNodes>;

  [[nodiscard]] bool keep(Cell cell, int point) noexcept;
  [[nodiscard]] Refusal add_nodes(const Cells& cells, const Graph& graph, int layer) noexcept;
  [[nodiscard]] Refusal add_edges(const Cells& cells, const Graph& graph, int layer) noexcept;
  void look_along(const Cells& cells, Point a, Point b, int points, double radius_m) noexcept;

  // A layer is one radius and the agents that have it.
  int layers_ = 0;
  std::array<double, limits::kAgents> layer_radius_m_{};
  std::array<AgentSet, limits::kAgents> layer_agents_{};
  std::array<int, limits::kAgents> layer_of_agent_{};

  int events_ = 0;
  std::array<SightEvent, limits::kSightEvents> pool_{};
  std::array<EdgeRows, limits::kAgents> edge_rows_{};
  std::array<NodeRows, limits::kAgents> node_rows_{};
  std::array<std::int16_t, limits::kEdges> points_{};
  std::array<AgentSet, limits::kCells> observable_by_{};
  std::span<const double> mass_;

  // While building one edge: the cells in sight and the first and last point that sees each.
  std::array<Cell, limits::kCells> seen_{};
  int seen_count_ = 0;
  std::array<std::int16_t, limits::kCells> first_point_{};
  std::array<std::int16_t, limits::kCells> last_point_{};
};

}  // namespace ivo::planner
