// At which sight point each cell is first seen along an edge: what exact scoring needs. Made when an edge is first
// scored and kept in a ring, the oldest making room, so that the memory does not grow with the graph.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/world/sight_table.hpp"

namespace ivo::planner {

/// A cell and the sight point (visibility.hpp) at which it is first seen, packed in four bytes.
class SightEvent {
 public:
  static constexpr int kCellBits = std::bit_width(static_cast<unsigned>(limits::kCells - 1));
  static_assert(SightTable::kMaxPoint < 1 << (32 - kCellBits));

  SightEvent() = default;
  constexpr SightEvent(Cell cell, int point) noexcept
      : bits_(static_cast<std::uint32_t>(point) << kCellBits | static_cast<std::uint32_t>(cell)) {}
  [[nodiscard]] constexpr Cell cell() const noexcept { return static_cast<Cell>(bits_ & ((1U << kCellBits) - 1)); }
  [[nodiscard]] constexpr int point() const noexcept { return static_cast<int>(bits_ >> kCellBits); }

 private:
  std::uint32_t bits_ = 0;
};

class EdgeEvents {
 public:
  /// `kept` events at most are kept ready; the cells of each swath of an edge together must fit.
  EdgeEvents(const Cells& cells, const Graph& graph, const SightTable& sight, int kept = limits::kSightEvents) noexcept
      : cells_(cells), graph_(graph), sight_(sight), kept_(kept) {}

  /// Forgets all: another mission. Cost: the edges.
  void clear() noexcept;

  /// Works towards having the events of `e`, the edge from `tail`, for `agent`: about `rows` units of work, within a
  /// cell's points if it must; to begin and to end an edge is a part each. Returns the work done; 0 when they were
  /// ready.
  int prepare(int agent, Node tail, Edge e, int rows) noexcept;
  /// True when the edge can be made ready and no other has to make room for it.
  [[nodiscard]] bool has_room_for(int agent, Edge e) const noexcept {
    return head_ + most(agent, e) <= kept_ && block_count_ < kBlocks &&
           (block_count_ == 0 || blocks_[index(oldest_)].first < head_);
  }
  [[nodiscard]] bool ready(int agent, Edge e) const noexcept { return slots_[slot(agent, e)].count >= 0; }
  /// Cells seen along a ready edge and not from its tail: each once, at the first point that sees it.
  [[nodiscard]] std::span<const SightEvent> along(int agent, Edge e) const noexcept {
    const Slot s = slots_[slot(agent, e)];
    return {pool_.data() + s.first, static_cast<std::size_t>(s.count)};
  }

 private:
  struct Slot {
    std::int32_t first = 0;
    std::int32_t count = -1;
  };
  struct Block {  // of the ring, in order of making
    std::int32_t first = 0;
    std::int32_t size = 0;
    std::int32_t slot = -1;
  };
  // The swaths of any edge fit: there are three that may each see the whole map, or more that see less
  // (sight_table.cpp).
  static_assert(limits::kSightEvents >= 3 * limits::kCells);
  static constexpr int kBlocks = limits::kSightEvents / 64;

  [[nodiscard]] std::size_t slot(int agent, Edge e) const noexcept {
    return index(sight_.layer(agent)) * limits::kEdges + index(e);
  }
  [[nodiscard]] int most(int agent, Edge e) const noexcept;
  int begin(int agent, Node tail, Edge e) noexcept;
  void make_room(int size) noexcept;
  bool add_row(const Swath& swath, int rows, int& work) noexcept;
  bool find_first_point(int column, int row, int from, int to, int rows, int& work) noexcept;
  [[nodiscard]] bool sees(int point, int column, int row, int& work) const noexcept;
  void finish(int agent, Node tail, Edge e) noexcept;

  const Cells& cells_;
  const Graph& graph_;
  const SightTable& sight_;
  const int kept_;
  std::array<Slot, static_cast<std::size_t>(limits::kAgents) * limits::kEdges> slots_{};
  std::array<SightEvent, limits::kSightEvents> pool_{};
  std::array<Block, kBlocks> blocks_{};
  int oldest_ = 0;
  int block_count_ = 0;
  int head_ = 0;  // where the next block begins

  // The edge under way.
  std::size_t making_ = kNone;
  static constexpr std::size_t kNone = ~std::size_t{0};
  int made_first_ = 0;
  int made_ = 0;
  Point tail_{};
  Point end_{};
  double radius_m_ = 0.0;
  int points_ = 0;
  bool reversed_ = false;
  bool open_ = false;  // nothing near can hide anything
  std::size_t swath_ = 0;
  int row_ = 0;
  static constexpr int kNotBegun = -1;
  int point_ = kNotBegun;  // asked next, of the cell under way
  SeenMap taken_;          // cells of the edge that have their event, or are seen from the tail
};

}  // namespace ivo::planner
