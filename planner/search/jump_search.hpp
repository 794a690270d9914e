// Shortest paths from one node, one node at a time, until the caller has found what it looks for (Dijkstra with an
// indexed heap). The nearest nodes of a start are remembered: ants jump from the same nodes again and again.
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/world/graph.hpp"

namespace ivo::planner {

class JumpSearch {
 public:
  static constexpr Node kCatchingUp = -2;

  /// Another graph: forgets all. Cost: agents times nodes.
  void open(const Graph& graph) noexcept;
  /// Starts at `from` over the edges open to `agent`. Cost: constant.
  void start(int agent, Node from) noexcept;

  /// The next nearest node, lowest index on a tie; -1 when all that can be reached are settled; kCatchingUp when it
  /// must be called again: behind the remembered nodes the search itself has to follow. Cost: a node's edges, each with
  /// a logarithm, and once the nodes of the last search; of a remembered one, constant.
  [[nodiscard]] Node settle_next() noexcept;

  /// The edge by which a settled node is reached, -1 for the start.
  [[nodiscard]] Edge edge_to(Node n) const noexcept { return edge_to_[index(n)]; }
  /// Of a settled node from the start, along the edges.
  [[nodiscard]] double distance_m(Node n) const noexcept { return distance_m_[index(n)]; }
  /// The node before it.
  [[nodiscard]] Node before(Node n) const noexcept { return before_[index(n)]; }
  /// Edges looked at since start, and what else takes as long.
  [[nodiscard]] int work() const noexcept { return work_; }

 private:
  static constexpr std::int32_t kOutside = -1;
  static constexpr std::int32_t kSettled = -2;

  struct Settled {
    Node node = 0;
    Node before = 0;
    Edge edge = 0;
    double distance_m = 0.0;
  };
  // The nearest nodes of one start. The oldest makes room for another.
  static constexpr std::int32_t kRemembered = 96;
  struct Neighbourhood {
    std::int32_t owner = -1;  // whose: slot of agent and node
    std::int32_t count = 0;
    bool whole = false;  // there are no more nodes
    std::array<Settled, kRemembered> nodes{};
  };
  static constexpr std::size_t kNeighbourhoods = limits::kNodes / 4;
  static constexpr std::int16_t kNone = -1;

  [[nodiscard]] Neighbourhood& remembered() noexcept { return neighbourhoods_[index(neighbourhood_of_[owner_])]; }
  void begin_search() noexcept;
  [[nodiscard]] Node settle() noexcept;
  [[nodiscard]] bool nearer(Node a, Node b) const noexcept {
    return distance_m_[index(a)] < distance_m_[index(b)] || (distance_m_[index(a)] == distance_m_[index(b)] && a < b);
  }
  void place(Node n, std::int32_t slot) noexcept;
  void rise(Node n) noexcept;
  void sink(Node n) noexcept;

  const Graph* graph_ = nullptr;
  int agent_ = 0;
  Node from_ = 0;
  int work_ = 0;
  std::size_t owner_ = 0;      // of the neighbourhood in use
  std::int32_t told_ = 0;      // nodes told since start
  std::int32_t followed_ = 0;  // settled by the search itself; it begins when what is remembered is told
  bool searching_ = false;

  std::array<Neighbourhood, kNeighbourhoods> neighbourhoods_{};
  std::size_t oldest_ = 0;
  std::array<std::int16_t, static_cast<std::size_t>(limits::kAgents) * limits::kNodes> neighbourhood_of_{};

  std::array<Node, limits::kNodes> touched_{};
  int touched_count_ = 0;
  std::array<Node, limits::kNodes> heap_{};
  std::int32_t heap_size_ = 0;
  std::array<std::int32_t, limits::kNodes> slot_{};  // in the heap, or outside, or settled
  std::array<double, limits::kNodes> distance_m_{};
  std::array<Edge, limits::kNodes> edge_to_{};
  std::array<Node, limits::kNodes> before_{};
};

}  // namespace ivo::planner
