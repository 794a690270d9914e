#include "planner/world/clearance_map.hpp"

#include <algorithm>
#include <cmath>

namespace ivo::planner {

void ClearanceMap::build(const SegmentedMap& map, const Cells& cells, ClassSet blocked) noexcept {
  columns_ = cells.columns();
  rows_ = cells.rows();
  cell_ticks_ = cells.cell_m() * kTicksAMetre;
  constexpr auto kFar = static_cast<std::uint8_t>(kReach);
  std::fill_n(below_.begin(), cells.count(), kFar);
  const double size = map.resolution_m;
  const double cell = cells.cell_m();
  for (int y = 0; y < map.height_px; ++y) {
    for (int x = 0; x < map.width_px; ++x) {
      if (((blocked >> static_cast<unsigned>(map.at(x, y))) & 1U) == 0) {
        continue;
      }
      const int last_row = std::min(rows_ - 1, static_cast<int>((y + 1) * size / cell));
      const int last_column = std::min(columns_ - 1, static_cast<int>((x + 1) * size / cell));
      for (int row = static_cast<int>(y * size / cell); row <= last_row; ++row) {
        for (int column = static_cast<int>(x * size / cell); column <= last_column; ++column) {
          below_[index(row * columns_ + column)] = 0;
        }
      }
    }
  }
  for (int column = 0; column < columns_; ++column) {
    for (int row = 1; row < rows_; ++row) {
      std::uint8_t& here = below_[index(row * columns_ + column)];
      here = static_cast<std::uint8_t>(std::min<int>(here, below_[index((row - 1) * columns_ + column)] + 1));
    }
    for (int row = rows_ - 2; row >= 0; --row) {
      std::uint8_t& here = below_[index(row * columns_ + column)];
      here = static_cast<std::uint8_t>(std::min<int>(here, below_[index((row + 1) * columns_ + column)] + 1));
    }
  }
  // Between two places of two cells lies at least the distance of the centres less a diagonal. Rounded down.
  std::array<std::uint16_t, 2 * kReach * kReach + 1> ticks_of{};
  for (std::size_t squared = 0; squared < ticks_of.size(); ++squared) {
    const double free = (std::sqrt(static_cast<double>(squared)) - std::sqrt(2.0)) * cell_ticks_ - 1.0;
    ticks_of[squared] = static_cast<std::uint16_t>(std::clamp(free, 0.0, 65535.0));
  }
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      int nearest = kReach * kReach;
      for (int x = std::max(0, column - kReach); x <= std::min(columns_ - 1, column + kReach); ++x) {
        const int up = below_[index(row * columns_ + x)];
        nearest = std::min(nearest, (x - column) * (x - column) + up * up);
      }
      ticks_[index(row * columns_ + column)] = ticks_of[index(nearest)];
    }
  }
}

bool ClearanceMap::surely_free(Spot a, Spot b, int radius) const noexcept {
  const auto length = static_cast<std::int64_t>(std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)));
  // Along the longer axis a step of s moves at most 1.5 s.
  for (std::int64_t at = 0;;) {
    const Spot here{a.x + static_cast<std::int32_t>(length > 0 ? (b.x - a.x) * at / length : 0),
                    a.y + static_cast<std::int32_t>(length > 0 ? (b.y - a.y) * at / length : 0)};
    const int slack = at_least(here) - radius - 1;
    if (slack <= 0) {
      return false;
    }
    if (at == length) {
      return true;
    }
    at = std::min<std::int64_t>(length, at + std::max(1, slack * 2 / 3));
  }
}

}  // namespace ivo::planner
