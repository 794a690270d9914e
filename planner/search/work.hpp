// What the parts of a search cost, in units of work: a unit is about 50 instructions of a Cortex-M7 and 10 of an
// x86-64, one row of 64 cells looked at. Fitted to instruction counts of the fixed-point build on the M7
// (tests/cross/slice_costs), so that slices of equal budgets are of equal length whatever they do.
#pragma once

namespace ivo::planner::work {

// Ants.
[[nodiscard]] constexpr int choice(int edges) noexcept { return 2 + edges * 2 / 5; }
/// What a heuristic of the moment adds to it.
[[nodiscard]] constexpr int visibilities(int edges) noexcept { return edges * 3 / 2; }
[[nodiscard]] constexpr int sectors_opened(int edges) noexcept { return edges * 4; }
[[nodiscard]] constexpr int tiles_weighed(int tiles, int ways) noexcept { return tiles + ways * 12 / 5; }
[[nodiscard]] constexpr int tiles_taken(int cells, int priors) noexcept { return cells * (1 + priors); }
[[nodiscard]] constexpr int rows_shown(int rows, int new_cells) noexcept { return rows + new_cells * 2 / 5; }
[[nodiscard]] constexpr int rows_searched(int rows) noexcept { return rows * 2 / 5; }
[[nodiscard]] constexpr int settled(int edges) noexcept { return 7 + edges * 2 / 3; }
/// Rows taken between two looks at the budget: where all is new a row is up to 27 units, or 150 by sectors.
inline constexpr int kRowsAtOnce = 64;
inline constexpr int kRowsAtOnceBySectors = 4;
inline constexpr int kMoveEnd = 38;
inline constexpr int kBytesCopied = 64;  // for one unit
[[nodiscard]] constexpr int bytes(int count) noexcept { return count / kBytesCopied; }
inline constexpr int kTilesCopied = 8;  // for one unit, of a prior

// Exact scores of tours.
[[nodiscard]] constexpr int points_timed(int points) noexcept { return points / 2; }
[[nodiscard]] constexpr int rows_opened(int rows) noexcept { return rows * 3 / 5; }
[[nodiscard]] constexpr int events_replayed(int events, int taken) noexcept { return (events + taken) * 3 / 10; }
[[nodiscard]] constexpr int cells_summed(int cells, bool sub_priors) noexcept {
  return sub_priors ? cells * 12 / 5 : cells * 36 / 25;
}
inline constexpr int kCellsForgotten = 4;  // for one unit

// Trails.
[[nodiscard]] constexpr int raised(int trails) noexcept { return trails / 14; }
[[nodiscard]] constexpr int evaporated(int trails) noexcept { return trails / 6; }
[[nodiscard]] constexpr int clamped(int trails) noexcept { return trails * 2 / 7; }

// Changes of a route.
inline constexpr int kProposal = 48;
[[nodiscard]] constexpr int legs(int count) noexcept { return count / 2; }
inline constexpr int kSegment = 28;
inline constexpr int kPart = 10;
inline constexpr int kSweptRow = 7;
inline constexpr int kJudgement = 20;
[[nodiscard]] constexpr int rows_judged(int rows, int planes_read) noexcept {
  return rows * 4 / 5 + planes_read * 8 / 7;
}

// Discs and rays of exact looks.
[[nodiscard]] constexpr int disc_row(int new_cells) noexcept { return 4 + new_cells * 5 / 2; }
/// A grid walk over so many cells.
[[nodiscard]] constexpr int ray(int walked) noexcept { return 2 + walked * 2 / 5; }

}  // namespace ivo::planner::work
