#include "planner/search/bounds.hpp"

#include <cmath>
#include <numbers>

#include "planner/numeric/index.hpp"

namespace ivo::planner {
namespace {

constexpr float kNever = 1e30F;
constexpr float kRoundedDown = 1.0F - 1e-6F;

double square(double x) noexcept { return x * x; }

// The sensor's own margin included (visibility.hpp).
double sight_m(const BoundAgent& agent) noexcept { return std::sqrt(square(agent.sight_radius_m) + 1e-9); }

}  // namespace

void BoundTable::build(const SegmentedMap& map, const Cells& cells, const Belief& belief,
                       std::span<const BoundAgent> agents) noexcept {
  count_ = belief.mass_cell_count;
  whole_ = to_double(belief.whole);
  for (const Cell c : belief.cells_with_mass()) {
    reach_s_[index(c)] = kNever;
  }
  Sweep nominal;
  Sweep strict;
  for (const BoundAgent& agent : agents) {
    find_reach(map, cells, belief, agent);
    const double strict_m = sight_m(agent) + cells.cell_m() / std::numbers::sqrt2;
    nominal.base_m2 += std::numbers::pi * square(agent.sight_radius_m);
    nominal.rate_m2ps += 2.0 * agent.sight_radius_m * agent.speed_mps;
    strict.base_m2 += std::numbers::pi * square(strict_m);
    strict.rate_m2ps += 2.0 * strict_m * agent.speed_mps;
  }
  const double cell_m2 = square(cells.cell_m());
  end_s_ = std::max(0.0, (count_ * cell_m2 - nominal.base_m2) / nominal.rate_m2ps);
  for (const Cell c : belief.cells_with_mass()) {
    float& reach = reach_s_[index(c)];
    reach = reach < kNever ? reach * kRoundedDown : 0.0F;
    end_s_ = std::max<double>(end_s_, reach);
  }
  order_by_mass(belief);
  order_by_instant();
  available_.start({by_mass_.data(), index(count_)}, belief.mass);
  integrate(belief, cell_m2, nominal, strict);
}

void BoundTable::find_reach(const SegmentedMap& map, const Cells& cells, const Belief& belief,
                            const BoundAgent& agent) noexcept {
  const double radius_m = sight_m(agent);
  way_.build(map, cells, agent.walker, by_mass_, by_instant_);
  for (int row = 0; row < cells.rows(); ++row) {
    if (way_.any_blocked()) {
      way_.nearest_within(cells, row, radius_m, by_instant_, by_mass_);
    }
    for (int column = 0; column < cells.columns(); ++column) {
      const Cell c = cells.at(column, row);
      const WayField::Steps steps = way_.any_blocked() ? by_instant_[index(column)] : 0;
      if (to_double(belief.mass[index(c)]) <= 0.0 || steps == WayField::kNowhere) {
        continue;
      }
      const Point centre = cells.centre(c);
      const double straight_m =
          std::sqrt(square(centre.x_m - agent.walker.start.x_m) + square(centre.y_m - agent.walker.start.y_m)) -
          radius_m;
      const double reach_s = std::max({0.0, straight_m, way_.metres(steps)}) / agent.speed_mps;
      reach_s_[index(c)] = std::min(reach_s_[index(c)], static_cast<float>(reach_s));
    }
  }
}

void BoundTable::order_by_mass(const Belief& belief) noexcept {
  const std::span<const Cell> with_mass = belief.cells_with_mass();
  std::copy(with_mass.begin(), with_mass.end(), by_mass_.begin());
  std::sort(by_mass_.begin(), by_mass_.begin() + count_, [&](Cell a, Cell b) {
    const double mass_a = to_double(belief.mass[index(a)]);
    const double mass_b = to_double(belief.mass[index(b)]);
    return mass_a > mass_b || (mass_a == mass_b && a < b);
  });
}

double BoundTable::instant_s(int k) const noexcept { return end_s_ * square(static_cast<double>(k) / kInstants); }

int BoundTable::instant_of(std::int32_t rank) const noexcept {
  constexpr double kRounding = 1e-6;  // an instant too early is safe
  const double reach_s = reach_s_[index(by_mass_[index(rank)])];
  const double share = end_s_ > 0.0 ? std::sqrt(reach_s / end_s_) : 0.0;
  return std::clamp(static_cast<int>(std::ceil(share * kInstants - kRounding)), 0, kInstants);
}

// By counting.
void BoundTable::order_by_instant() noexcept {
  end_of_instant_.fill(0);
  for (std::int32_t rank = 0; rank < count_; ++rank) {
    ++end_of_instant_[index(instant_of(rank))];
  }
  for (std::size_t k = 1; k < end_of_instant_.size(); ++k) {
    end_of_instant_[k] += end_of_instant_[k - 1];
  }
  for (std::int32_t rank = count_ - 1; rank >= 0; --rank) {
    by_instant_[index(--end_of_instant_[index(instant_of(rank))])] = rank;
  }
}

void BoundTable::integrate(const Belief& belief, double cell_m2, const Sweep& nominal, const Sweep& strict) noexcept {
  // The first `count` of all cells by mass, for counts that only grow.
  struct Largest {
    std::int32_t whole = 0;
    double sum = 0.0;
  };
  const auto largest_of_all = [&](Largest& largest, double count) {
    while (largest.whole < count_ && largest.whole + 1 <= count) {
      largest.sum += to_double(belief.mass[index(by_mass_[index(largest.whole++)])]);
    }
    const double part = std::max(0.0, count - largest.whole);
    return largest.whole < count_ ? largest.sum + part * to_double(belief.mass[index(by_mass_[index(largest.whole)])])
                                  : largest.sum;
  };
  Largest of_nominal;
  Largest of_strict;
  std::int32_t added = 0;
  for (int k = 0; k <= kInstants; ++k) {
    const double t_s = instant_s(k);
    const double nominal_cells = (nominal.base_m2 + nominal.rate_m2ps * t_s) / cell_m2;
    const double strict_cells = (strict.base_m2 + strict.rate_m2ps * t_s) / cell_m2;
    for (; added < count_ && instant_of(by_instant_[index(added)]) <= k; ++added) {
      available_.add(by_instant_[index(added)]);
    }
    area_nominal_[index(k)] = largest_of_all(of_nominal, nominal_cells);
    area_strict_[index(k)] = largest_of_all(of_strict, strict_cells);
    reach_nominal_[index(k)] = available_.largest(nominal_cells);
    reach_strict_[index(k)] = available_.largest(strict_cells);
  }
}

double BoundTable::integral_s(const Curve& f, double unseen_mass) const noexcept {
  constexpr double kRounding = 1e-9;  // of sums of masses
  double sum_s = 0.0;
  for (int k = 1; k <= kInstants; ++k) {
    const double seen = f[index(k)] / whole_;
    if (seen >= 1.0 - unseen_mass - kRounding) {
      break;
    }
    sum_s += (instant_s(k) - instant_s(k - 1)) * (1.0 - seen);
  }
  return sum_s;
}

Bounds BoundTable::at(double unseen_mass) const noexcept {
  return {.area = {integral_s(area_nominal_, unseen_mass), integral_s(area_strict_, unseen_mass)},
          .reach = {integral_s(reach_nominal_, unseen_mass), integral_s(reach_strict_, unseen_mass)}};
}

}  // namespace ivo::planner
