#include "planner/prior/preferences.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "planner/numeric/index.hpp"

namespace ivo::planner {
namespace {

// Of the mean cell's mass: what lies farther out than 5 sigma is not worth a way there.
constexpr double kNegligibleShare = 1e-5;
// Of all: what fixed point would round to nothing counts as nothing in doubles too.
constexpr double kLeastShare = 0x1p-32;

Refusal check_areas(const Cells& cells, const SightTable& sight, const PreferredAreas& preferred,
                    const Belief& belief) noexcept {
  for (std::size_t agent = 0; agent < preferred.size(); ++agent) {
    for (std::size_t area = 0; area < preferred[agent].size(); ++area) {
      bool covers_mass = false;
      for (const Cell c : belief.cells_with_mass()) {
        if (in(sight.observable_by(c), static_cast<int>(agent)) && contains(preferred[agent][area], cells.centre(c))) {
          covers_mass = true;
          break;
        }
      }
      if (!covers_mass) {
        return {
            .code = RefusalCode::kAreaWithoutMass, .agent = static_cast<int>(agent), .area = static_cast<int>(area)};
      }
    }
  }
  return {};
}

}  // namespace

Refusal normalise(const Cells& cells, const SightTable& sight, int agents, std::span<const double> raw,
                  Belief& belief) noexcept {
  double whole = 0.0;
  double observable = 0.0;
  AgentSet observers = 0;
  belief.cells = cells.count();
  belief.agents = agents;
  belief.mass_cell_count = 0;
  for (Cell c = 0; c < cells.count(); ++c) {
    if (!(raw[index(c)] >= 0.0)) {
      return {.code = RefusalCode::kPriorNotFinite, .value = raw[index(c)]};
    }
    whole += raw[index(c)];
    if (sight.observable_by(c) != 0) {
      observable += raw[index(c)];
    }
  }
  if (!std::isfinite(whole)) {
    return {.code = RefusalCode::kPriorNotFinite, .value = whole};
  }
  if (whole <= 0.0) {
    return {.code = RefusalCode::kPriorWithoutMass};
  }
  const double negligible = observable * std::max(kNegligibleShare / cells.count(), kLeastShare);
  const auto counts = [&](Cell c) { return sight.observable_by(c) != 0 && raw[index(c)] > negligible; };
  double kept = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (Cell c = 0; c < cells.count(); ++c) {
    if (counts(c)) {
      kept += raw[index(c)];
      least = std::min(least, raw[index(c)]);
      most = std::max(most, raw[index(c)]);
      observers = static_cast<AgentSet>(observers | sight.observable_by(c));
    }
  }
  for (int agent = 0; agent < agents; ++agent) {
    if (!in(observers, agent)) {
      return {.code = RefusalCode::kNoMassObservable, .agent = agent};
    }
  }
  belief.unobservable_share = std::max(0.0, 1.0 - observable / whole);
  belief.without_mass.open(cells.columns(), cells.rows());
  belief.alike = Mass{};
  belief.whole = Mass{};
  const bool alike = least == most;  // and stay so: nothing is lost where all are shares of their own sum
  MassRounding rounding;
  for (Cell c = 0; c < cells.count(); ++c) {
    Mass& mass = belief.mass[index(c)];
    const double share = counts(c) ? raw[index(c)] / kept : 0.0;
    mass = alike ? mass_from(share) : rounding.round(share);
    if (mass <= Mass{}) {
      belief.without_mass.set(cells.column(c), cells.row(c));
      continue;
    }
    belief.whole += mass;
    belief.alike = belief.mass_cell_count == 0 || belief.alike == mass ? mass : Mass{};
    belief.mass_cells[index(belief.mass_cell_count++)] = c;
  }
  return {};
}

Refusal divide(const Cells& cells, const SightTable& sight, const PreferredAreas& preferred, Belief& belief,
               AgentSet& left_without) noexcept {
  left_without = 0;
  AgentSet stated = 0;
  for (std::size_t m = 0; m < preferred.size(); ++m) {
    stated = static_cast<AgentSet>(stated | (preferred[m].empty() ? 0U : agent_bit(static_cast<int>(m))));
  }
  belief.has_sub_priors = stated != 0;
  if (!belief.has_sub_priors) {
    return {};
  }
  if (const Refusal refusal = check_areas(cells, sight, preferred, belief)) {
    return refusal;
  }
  const auto all = static_cast<AgentSet>((1U << static_cast<unsigned>(belief.agents)) - 1);
  const AgentSet takers_of_the_rest = stated == all ? all : static_cast<AgentSet>(all & ~stated);
  std::array<double, limits::kAgents> sums{};
  for (int m = 0; m < belief.agents; ++m) {
    std::fill_n(belief.sub_mass[index(m)].begin(), belief.cells, Mass{});  // of an earlier mission
  }
  for (const Cell c : belief.cells_with_mass()) {
    AgentSet takers = 0;
    for (int m = 0; m < belief.agents; ++m) {
      if (contains(preferred[index(m)], cells.centre(c))) {
        takers = static_cast<AgentSet>(takers | agent_bit(m));
      }
    }
    if (takers == 0) {
      takers = takers_of_the_rest;
    }
    const double part = to_double(belief.mass[index(c)]) / std::popcount(takers);
    for (int m = 0; m < belief.agents; ++m) {
      const bool counts = in(takers, m) && in(sight.observable_by(c), m);
      belief.sub_mass[index(m)][index(c)] =
          Mass(counts ? std::popcount(takers) : 0);  // how many share it, until scaled
      sums[index(m)] += counts ? part : 0.0;
    }
  }
  for (int m = 0; m < belief.agents; ++m) {
    fill_sub_prior(m, sums[index(m)], belief, left_without, [&](Cell c) {
      const double takers = to_double(belief.sub_mass[index(m)][index(c)]);
      return takers > 0.0 ? to_double(belief.mass[index(c)]) / takers : 0.0;
    });
  }
  return {};
}

}  // namespace ivo::planner
