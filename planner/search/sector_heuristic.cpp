#include "planner/search/sector_heuristic.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "planner/numeric/exponential.hpp"
#include "planner/search/work.hpp"

namespace ivo::planner {
namespace {

constexpr double kLogLambda = -0.22314355131420976;  // ln 0.8
constexpr int kDiscountOne = 1 << 15;                // of a discount

// |angle| <= 22.5 degrees: tan 22.5 = sqrt(2) - 1, in 1/4096.
constexpr std::int64_t kTanScale = 4096;
constexpr std::int64_t kTan = 1697;

}  // namespace

void SectorHeuristic::open() noexcept {
  const Cells& cells = world_.cells;
  columns_ = (cells.columns() + kTile - 1) / kTile;
  tiles_ = columns_ * ((cells.rows() + kTile - 1) / kTile);
  units_a_metre_ = kUnitsACell / cells.cell_m();
  const double spacing = world_.graph.spacing_m() * units_a_metre_;
  spacing_units2_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(spacing * spacing, 0x1p60)));
  for (int i = 0; i < kDiscounts; ++i) {
    const auto discount = [](double squared) {
      return static_cast<std::int32_t>(kDiscountOne * exp_negative(kLogLambda * std::sqrt(squared)) + 0.5);
    };
    near_discount_[index(i)] = discount((i + 0.5) / 32.0);
    far_discount_[index(i)] = discount((i + 0.5) * 2.0);
  }
  const Belief& belief = world_.belief;
  priors_ = belief.has_sub_priors ? belief.agents : 1;
  for (int m = 0; m < priors_; ++m) {
    std::fill_n(whole_[index(m)].begin(), tiles_, Mass{});
    for (const Cell c : belief.cells_with_mass()) {
      const int tile = cells.row(c) / kTile * columns_ + cells.column(c) / kTile;
      whole_[index(m)][index(tile)] +=
          belief.has_sub_priors ? belief.sub_mass[index(m)][index(c)] : belief.mass[index(c)];
    }
  }
}

int SectorHeuristic::start_tiles(int rows) noexcept {
  const int count = std::min(std::max(1, rows * work::kTilesCopied / priors_), tiles_ - started_tiles_);
  for (int m = 0; m < priors_; ++m) {
    std::copy_n(whole_[index(m)].begin() + started_tiles_, count, unseen_[index(m)].begin() + started_tiles_);
  }
  started_tiles_ += count;
  return 1 + count * priors_ / work::kTilesCopied;
}

void SectorHeuristic::take(Cell c) noexcept {
  const Belief& belief = world_.belief;
  const int tile = world_.cells.row(c) / kTile * columns_ + world_.cells.column(c) / kTile;
  for (int m = 0; m < priors_; ++m) {
    unseen_[index(m)][index(tile)] -=
        belief.has_sub_priors ? belief.sub_mass[index(m)][index(c)] : belief.mass[index(c)];
  }
}

std::int32_t SectorHeuristic::units(double metres) const noexcept {
  return static_cast<std::int32_t>(std::floor(metres * units_a_metre_ + 0.5));
}

// Directions in 64 bins by the diamond angle, which grows with the angle and needs no arc tangent.
int SectorHeuristic::bin_of(std::int64_t dx, std::int64_t dy) noexcept {
  const std::int64_t sum = std::abs(dx) + std::abs(dy);
  if (sum == 0) {
    return 0;
  }
  constexpr int kQuarter = kBins / 4;
  const auto part = static_cast<int>(std::min<std::int64_t>(std::abs(dy) * kQuarter / sum, kQuarter - 1));
  if (dx >= 0) {
    return dy >= 0 ? part : kBins - 1 - part;
  }
  return dy >= 0 ? 2 * kQuarter - 1 - part : 2 * kQuarter + part;
}

int SectorHeuristic::begin(int agent, Node here) noexcept {
  const Graph& graph = world_.graph;
  prior_ = priors_ > 1 ? agent : 0;
  first_edge_ = graph.first_edge(here);
  neighbours_ = graph.end_edge(here) - first_edge_;
  here_x_ = units(graph.position(here).x_m);
  here_y_ = units(graph.position(here).y_m);
  in_bin_ = {};
  best_ = Sum{};
  for (int i = 0; i < neighbours_; ++i) {
    const Edge e = first_edge_ + i;
    const Point to = graph.position(graph.head(e));
    Way& way = ways_[index(i)];
    way = {units(to.x_m) - here_x_, units(to.y_m) - here_y_, std::max(1, units(graph.length_m(e)))};
    sums_[index(i)] = Sum{};
    take_in(way, index(i));
  }
  tile_ = 0;
  return work::sectors_opened(neighbours_);
}

// The bins between the two sides of the sector: the way turned by 22.5 degrees either side.
void SectorHeuristic::take_in(const Way& way, std::size_t neighbour) noexcept {
  const std::int64_t dx = way.dx;
  const std::int64_t dy = way.dy;
  const int from = bin_of(dx * kTanScale + dy * kTan, dy * kTanScale - dx * kTan);
  const int to = bin_of(dx * kTanScale - dy * kTan, dy * kTanScale + dx * kTan);
  for (int bin = from;; bin = (bin + 1) % kBins) {
    in_bin_[index(bin)][neighbour / 64] |= std::uint64_t{1} << (neighbour % 64);
    if (bin == to) {
      break;
    }
  }
}

int SectorHeuristic::advance(int rows) noexcept {
  constexpr int kUnitsATile = kTile * kUnitsACell;
  const int first = tile_;
  int ways = 0;
  for (; tile_ < tiles_ && work::tiles_weighed(tile_ - first, ways) < rows; ++tile_) {
    const Mass mass = unseen_[index(prior_)][index(tile_)];
    if (mass > Mass{}) {
      ways += weigh(mass, (tile_ % columns_) * kUnitsATile + kUnitsATile / 2 - here_x_,
                    (tile_ / columns_) * kUnitsATile + kUnitsATile / 2 - here_y_);
    }
  }
  const int work = 1 + work::tiles_weighed(tile_ - first, ways);
  if (tile_ == tiles_) {
    close();
  }
  return work;
}

// Unseen mass at (dx, dy) from here. How many ways it was looked at for.
int SectorHeuristic::weigh(Mass mass, std::int64_t dx, std::int64_t dy) noexcept {
  const auto& sectors = in_bin_[index(bin_of(dx, dy))];
  int ways = 0;
  for (std::size_t half = 0; half < sectors.size(); ++half) {
    ways += std::popcount(sectors[half]);
    for_each_bit(sectors[half], [&](int bit) {
      const std::size_t i = half * 64 + static_cast<std::size_t>(bit);
      const Way& way = ways_[i];
      const std::int64_t dot = dx * way.dx + dy * way.dy;
      const std::int64_t cross = dx * way.dy - dy * way.dx;
      if (dot <= 0 || std::abs(cross) * kTanScale > dot * kTan) {
        return;
      }
      const std::int64_t ex = dx - way.dx;
      const std::int64_t ey = dy - way.dy;
      const std::int64_t squared = (ex * ex + ey * ey) * 32 / spacing_units2_;
      const std::int32_t discount =
          squared < kDiscounts
              ? near_discount_[static_cast<std::size_t>(squared)]
              : far_discount_[static_cast<std::size_t>(std::min<std::int64_t>(squared / 64, kDiscounts - 1))];
#if IVO_PLANNER_FIXED
      sums_[i] += static_cast<std::uint64_t>(mass.raw()) * static_cast<std::uint64_t>(discount);
#else
      sums_[i] += mass * discount * (1.0 / kDiscountOne);
#endif
    });
  }
  return ways;
}

void SectorHeuristic::close() noexcept {
  for (int i = 0; i < neighbours_; ++i) {
    Sum& sum = sums_[index(i)];
#if IVO_PLANNER_FIXED
    constexpr Sum kFloor = 70'368'744;  // 1e-6
    sum = std::max(sum, kFloor) / static_cast<std::uint64_t>(ways_[index(i)].length);
#else
    sum = std::max(sum, 1e-6) / ways_[index(i)].length;
#endif
    best_ = std::max(best_, sum);
  }
}

Visibility SectorHeuristic::visibility(Edge e, int beta) const noexcept {
  return visibility_of(sums_[index(e - first_edge_)], best_, beta);
}

}  // namespace ivo::planner
