// What is seen from each node and along each edge, kept as swaths of a few sight points (seen_map.hpp): about 0.9 kB an
// edge of 9 m at 0.25 m cells, one record for both directions. A planner's move costs a few dozen words and no ray.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/numeric/prefetch.hpp"
#include "planner/refusal.hpp"
#include "planner/world/cells.hpp"
#include "planner/world/graph.hpp"
#include "planner/world/seen_map.hpp"

namespace ivo::planner {

/// Sensing radius of each agent, R_m.
using SightRadii = std::array<double, limits::kAgents>;

/// The swaths of one node or edge. Against an edge's first direction they are taken from the last to the first, and
/// sight point k of n is point n - k of the record.
struct SightView {
  std::span<const Swath> swaths;
  bool reversed = false;

  [[nodiscard]] std::size_t size() const noexcept { return swaths.size(); }
  /// The i-th swath on the way.
  [[nodiscard]] const Swath& at(std::size_t i) const noexcept { return swaths[reversed ? swaths.size() - 1 - i : i]; }
};

class SightTable {
 public:
  /// Most sight points of an edge.
  static constexpr int kMaxPoint = 1023;

  /// Agents of one radius share their records. Refuses what is over a capacity, with what all of it would take. Cost:
  /// each edge's sight points times the disc's rows where nothing hides, times its cells elsewhere.
  [[nodiscard]] Refusal build(const Cells& cells, const Graph& graph, const SightRadii& radii_m) noexcept;

  /// What an agent sees from a node: one point.
  [[nodiscard]] SightView from_node(int agent, Node n) const noexcept {
    return view(node_records_[index(layer_of_agent_[index(agent)])][index(n)], false);
  }
  /// What it sees along an edge, both ends included.
  [[nodiscard]] SightView along_edge(int agent, Edge e) const noexcept {
    return view(edge_records_[index(layer_of_agent_[index(agent)])][index(e)], against_[index(e)]);
  }
  [[nodiscard]] const std::uint64_t* words(const Swath& swath) const noexcept {
    return words_.data() + swath.first_word;
  }
  /// Asks for what a move along one of the edges `first` to `first + count - 1` reads first.
  void prefetch_moves(int agent, Edge first, int count) const noexcept {
    prefetch(edge_records_[index(layer_of_agent_[index(agent)])].data() + first, count);
    prefetch(against_.data() + first, count);
    prefetch(points_.data() + first, count);
  }
  /// n of visibility.hpp: the edge's last sight point.
  [[nodiscard]] int points(Edge e) const noexcept { return points_[index(e)]; }
  [[nodiscard]] double radius_m(int agent) const noexcept {
    return layer_radius_m_[index(layer_of_agent_[index(agent)])];
  }
  /// Agents of one radius have one layer.
  [[nodiscard]] int layer(int agent) const noexcept { return layer_of_agent_[index(agent)]; }
  /// Agents that can see the cell from a node or an edge that they can get to.
  [[nodiscard]] AgentSet observable_by(Cell c) const noexcept { return observable_by_[index(c)]; }
  [[nodiscard]] int words_used() const noexcept { return word_count_; }

 private:
  struct Record {
    std::int32_t first = 0;
    std::int32_t count = 0;
  };

  [[nodiscard]] SightView view(Record record, bool reversed) const noexcept {
    return {{swaths_.data() + record.first, static_cast<std::size_t>(record.count)}, reversed};
  }
  void assign_layers(const Graph& graph, const SightRadii& radii_m) noexcept;
  [[nodiscard]] Refusal add_nodes(const Cells& cells, const Graph& graph, int layer) noexcept;
  [[nodiscard]] Refusal add_edges(const Cells& cells, const Graph& graph, int layer) noexcept;
  [[nodiscard]] Refusal add_edge(const Cells& cells, Point a, Point b, int points, double radius_m, Record& record,
                                 AgentSet agents) noexcept;
  void paint(const Cells& cells, Point from, double radius_m) noexcept;
  void cut(const Cells& cells, int common_byte, int first_point, int last_point, AgentSet agents) noexcept;
  void keep(const Swath& swath, AgentSet agents) noexcept;
  [[nodiscard]] bool fits() const noexcept;
  [[nodiscard]] bool fits_nowhere() const noexcept;
  [[nodiscard]] Refusal shortage() const noexcept;

  // A layer is one radius and the agents that have it.
  int layers_ = 0;
  std::array<double, limits::kAgents> layer_radius_m_{};
  std::array<AgentSet, limits::kAgents> layer_agents_{};
  std::array<int, limits::kAgents> layer_of_agent_{};

  int word_count_ = 0;  // what is kept, and beyond a capacity what would be
  int swath_count_ = 0;
  std::array<std::uint64_t, limits::kSightWords> words_{};
  std::array<Swath, limits::kSwaths> swaths_{};
  std::array<std::array<Record, limits::kEdges>, limits::kAgents> edge_records_{};
  std::array<std::array<Record, limits::kNodes>, limits::kAgents> node_records_{};
  std::array<bool, limits::kEdges> against_{};  // the record was made from the head to the tail
  std::array<std::int16_t, limits::kEdges> points_{};
  std::array<AgentSet, limits::kCells> observable_by_{};

  // While building: the cells of the swath under way and the rows and bytes that hold them.
  SeenMap canvas_;
  CellWindow painted_;
};

}  // namespace ivo::planner
