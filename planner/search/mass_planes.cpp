#include "planner/search/mass_planes.hpp"

#include <algorithm>
#include <limits>

namespace ivo::planner {
namespace {

// In [0, 1), spread evenly over neighbouring cells: multiples of the golden ratio's fraction (a Weyl sequence).
double dither(int column, int row) noexcept {
  const std::uint32_t mixed =
      static_cast<std::uint32_t>(column) * 0x9E3779B1U + static_cast<std::uint32_t>(row) * 0x5851F42DU;
  return static_cast<double>(mixed >> 8U) * 0x1p-24;
}

}  // namespace

void MassPlanes::build(const Cells& cells, const Belief& belief,
                       const std::array<Mass, limits::kCells>& mass) noexcept {
  double largest = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const Cell c : belief.cells_with_mass()) {
    const double p = to_double(mass[index(c)]);
    largest = std::max(largest, p);
    least = p > 0.0 ? std::min(least, p) : least;
    sum += p;
  }
  const bool alike = largest - least <= kMassUnit;  // but for their rounding
  count_ = alike ? 1 : kPlanes;
  for (int b = 0; b < count_; ++b) {
    planes_[index(b)].open(cells.columns(), cells.rows());
  }
  const int levels = (1 << count_) - 1;
  std::int64_t units = 0;
  for (const Cell c : belief.cells_with_mass()) {
    const int column = cells.column(c);
    const int row = cells.row(c);
    const double part = largest > 0.0 ? to_double(mass[index(c)]) / largest * levels : 0.0;
    const int level = std::min(levels, static_cast<int>(part + (alike ? 0.5 : dither(column, row))));
    units += level;
    for (int b = 0; b < count_; ++b) {
      if (((static_cast<unsigned>(level) >> static_cast<unsigned>(b)) & 1U) != 0) {
        planes_[index(b)].set(column, row);
      }
    }
  }
  for (int b = 0; b < count_; ++b) {
    weights_[index(b)] = units > 0 ? mass_from(sum / static_cast<double>(units) * (1 << b)) : Mass{};
  }
}

}  // namespace ivo::planner
