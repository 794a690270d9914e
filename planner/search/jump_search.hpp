// Shortest paths from one node, one node at a time, until the caller has found what it looks for (Dijkstra with an
// indexed heap).
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/world/graph.hpp"

namespace ivo::planner {

class JumpSearch {
 public:
  /// Starts at `from` over the edges open to `agent`. Cost: one per node of the last search.
  void start(const Graph& graph, int agent, Node from) noexcept;

  /// The next nearest node, lowest index on a tie; -1 when all that can be reached are settled. Cost: its edges, each
  /// with a logarithm.
  [[nodiscard]] Node settle_next() noexcept;

  /// The edge by which a settled node is reached, -1 for the start.
  [[nodiscard]] Edge edge_to(Node n) const noexcept { return edge_to_[index(n)]; }
  /// The node before it.
  [[nodiscard]] Node before(Node n) const noexcept { return before_[index(n)]; }
  [[nodiscard]] int work() const noexcept { return work_; }  ///< edges looked at since start

 private:
  static constexpr std::int32_t kOutside = -1;
  static constexpr std::int32_t kSettled = -2;

  [[nodiscard]] bool nearer(Node a, Node b) const noexcept {
    return distance_m_[index(a)] < distance_m_[index(b)] || (distance_m_[index(a)] == distance_m_[index(b)] && a < b);
  }
  void place(Node n, std::int32_t slot) noexcept;
  void rise(Node n) noexcept;
  void sink(Node n) noexcept;

  const Graph* graph_ = nullptr;
  int agent_ = 0;
  int work_ = 0;
  std::array<Node, limits::kNodes> touched_{};
  int touched_count_ = 0;
  std::array<Node, limits::kNodes> heap_{};
  std::int32_t heap_size_ = 0;
  std::array<std::int32_t, limits::kNodes> slot_{};  // in the heap, or outside, or settled
  std::array<double, limits::kNodes> distance_m_{};
  std::array<Edge, limits::kNodes> edge_to_{};
  std::array<Node, limits::kNodes> before_{};
  bool fresh_ = true;  // slot_ has never been filled
};

}  // namespace ivo::planner
