// eta_MTS, "regions of probability in different directions" (paper, "Sub-prior MTS-ACO"; the source gives no public
// formula: this is a reading, model.md "Search (MMAS)"): the unseen mass in the sector 22.5 degrees to each side of the
// way to a neighbour, apex here, each part discounted by 0.8^(its distance to the neighbour in units of h), over the
// length of the way, at least 1e-6 of it. Cells are taken 8 x 8 at the middle of their tile.
#pragma once

#include <array>
#include <cstdint>

#include "planner/numeric/roulette.hpp"
#include "planner/search/world.hpp"

namespace ivo::planner {

enum class Heuristic : std::uint8_t {
  kTsp,     ///< eta_TSP = 1 / d
  kMts,     ///< eta_MTS
  kUnseen,  ///< unseen mass along the way over its length: what the fast profile takes for eta_TSP
};

class SectorHeuristic {
 public:
  explicit SectorHeuristic(const World& world) noexcept : world_(world) {}

  /// Another mission. Cost: the cells with mass.
  void open() noexcept;
  /// A new ant: nothing taken, once start_tiles() has been called until it has started.
  void start() noexcept { started_tiles_ = 0; }
  /// About as many tiles as are a part of `rows` rows. Returns the work done.
  int start_tiles(int rows) noexcept;
  [[nodiscard]] bool started() const noexcept { return started_tiles_ == tiles_; }
  /// The team has seen `c`.
  void take(Cell c) noexcept;
  [[nodiscard]] int priors() const noexcept { return priors_; }

  /// An agent looks around from a node. Cost: its edges. Returns the work done.
  int begin(int agent, Node here) noexcept;
  /// A part of about `rows` rows. Returns the work done.
  int advance(int rows) noexcept;
  [[nodiscard]] bool done() const noexcept { return tile_ == tiles_; }
  /// When done: eta^beta of an edge of the node, over that of its best edge. Cost: beta.
  [[nodiscard]] Visibility visibility(Edge e, int beta) const noexcept;

 private:
  static constexpr int kTile = 8;
  static constexpr int kTilesMost = limits::kCells / 16 + 64;
  static constexpr int kBins = 64;  // of directions
  static constexpr int kDiscounts = 8192;
  static constexpr int kUnitsACell = 16;  // of length
#if IVO_PLANNER_FIXED
  using Sum = std::uint64_t;  // mass with 46 bits behind the point
#else
  using Sum = double;
#endif
  struct Way {  // to a neighbour, in units
    std::int32_t dx = 0;
    std::int32_t dy = 0;
    std::int32_t length = 0;
  };

  void take_in(const Way& way, std::size_t neighbour) noexcept;
  int weigh(Mass mass, std::int64_t dx, std::int64_t dy) noexcept;
  [[nodiscard]] static int bin_of(std::int64_t dx, std::int64_t dy) noexcept;
  [[nodiscard]] std::int32_t units(double metres) const noexcept;
  void close() noexcept;

  const World& world_;
  int columns_ = 0;  // of tiles
  int tiles_ = 0;
  int priors_ = 1;  // one an agent with sub-priors
  double units_a_metre_ = 0.0;
  std::array<std::array<Mass, kTilesMost>, limits::kAgents> whole_{};
  std::array<std::array<Mass, kTilesMost>, limits::kAgents> unseen_{};
  std::array<std::int32_t, kDiscounts>
      near_discount_{};  // by squared distance, 1/32 h^2 apart; 15 bits behind the point
  std::array<std::int32_t, kDiscounts> far_discount_{};  // likewise, 2 h^2 apart
  std::int64_t spacing_units2_ = 1;

  int started_tiles_ = 0;
  int tile_ = 0;
  int prior_ = 0;
  Edge first_edge_ = 0;
  int neighbours_ = 0;
  std::int32_t here_x_ = 0;
  std::int32_t here_y_ = 0;
  std::array<Way, limits::kNeighbours> ways_{};
  std::array<Sum, limits::kNeighbours> sums_{};
  std::array<std::array<std::uint64_t, limits::kNeighbours / 64>, kBins>
      in_bin_{};  // neighbours whose sector meets the bin
  Sum best_{};
};

}  // namespace ivo::planner
