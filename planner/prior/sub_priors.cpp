#include "planner/prior/sub_priors.hpp"

#include <algorithm>
#include <cmath>

#include "planner/numeric/index.hpp"
#include "planner/prior/preferences.hpp"

namespace ivo::planner {
namespace {

double dealt_density(const DealtComponents& dealt, std::span<const GaussianComponent> components, int agent,
                     Point p) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < components.size(); ++i) {
    sum += dealt.agent_of_component[i] == agent ? density(components[i], p) : 0.0;
  }
  return sum;
}

}  // namespace

std::int8_t nearest_agent(const GaussianComponent& component, std::span<const Point> starts) noexcept {
  const auto squared_m2 = [&](Point p) {
    const double dx = p.x_m - component.mean.x_m;
    const double dy = p.y_m - component.mean.y_m;
    return dx * dx + dy * dy;
  };
  const auto nearest =
      std::min_element(starts.begin(), starts.end(), [&](Point a, Point b) { return squared_m2(a) < squared_m2(b); });
  return static_cast<std::int8_t>(nearest - starts.begin());
}

Refusal give_sub_priors(const Cells& cells, const SightTable& sight, const SubPriorChoice& choice,
                        std::span<const GaussianComponent> components, Belief& belief,
                        AgentSet& left_without) noexcept {
  const auto* const dealt = std::get_if<DealtComponents>(&choice);
  const auto* const images = std::get_if<SubPriorImages>(&choice);
  belief.has_sub_priors = true;
  left_without = 0;
  for (int m = 0; m < belief.agents; ++m) {
    std::fill_n(belief.sub_mass[index(m)].begin(), belief.cells, Mass{});  // of an earlier mission
    const auto share_of = [&](Cell c) {
      if (!in(sight.observable_by(c), m)) {
        return 0.0;
      }
      const Point centre = cells.centre(c);
      return dealt != nullptr    ? dealt_density(*dealt, components, m, centre)
             : images != nullptr ? value_at(images->of_agent[index(m)], centre)
                                 : to_double(belief.mass[index(c)]);
    };
    double sum = 0.0;
    for (const Cell c : belief.cells_with_mass()) {
      sum += share_of(c);
    }
    if (!std::isfinite(sum)) {
      return {.code = RefusalCode::kPriorNotFinite, .agent = m, .value = sum};
    }
    fill_sub_prior(m, sum, belief, left_without, share_of);
  }
  return {};
}

}  // namespace ivo::planner
