#include "planner/search/expected_time.hpp"

#include <algorithm>

namespace ivo::planner {

void ExpectedTime::add(const Belief& belief, const FirstSightings& sightings, int first, int count) noexcept {
  for (int i = first; i < first + count; ++i) {
    const Cell c = belief.mass_cells[static_cast<std::size_t>(i)];
    if (!sightings.seen(c)) {
      continue;
    }
    const Sighting& s = sightings.of(c);
    const double p = belief.mass[static_cast<std::size_t>(c)];
    // Step 0 and step 1 are both credited from the first term of the sum on.
    const double steps = std::max(step_of(s.time_s), 1) - 1;
    seen_mass_ += p;
    mass_seconds_ += p * s.time_s;
    mass_steps_ += p * steps;
    if (belief.has_sub_priors) {
      const double q = belief.sub_mass[s.credited][static_cast<std::size_t>(c)];
      sub_mass_ += q;
      sub_mass_steps_ += q * std::min(steps, belief.sub_prior_steps);
    }
    extend_path(s.agent, s.time_s);
    extend_path(s.credited, s.credited_time_s);
  }
}

PlanScore ExpectedTime::score(const Belief& belief, double max_unseen_mass) const noexcept {
  PlanScore score;
  score.horizon_s = *std::max_element(path_end_s_.begin(), path_end_s_.end());
  score.unseen_mass = std::max(0.0, 1.0 - seen_mass_);
  score.complete = is_complete(score.unseen_mass, max_unseen_mass);
  score.expected_time_continuous_s = mass_seconds_ + score.unseen_mass * score.horizon_s;
  // sum over k = 1..N of [1 - P(k)]: a cell of step k counts in k - 1 terms, what stays unseen in all N.
  score.expected_time_s = (mass_steps_ + score.unseen_mass * step_of(score.horizon_s)) * kStepSeconds;
  if (belief.has_sub_priors) {
    score.expected_sub_prior_time_s =
        (sub_mass_steps_ + std::max(0.0, 1.0 - sub_mass_) * belief.sub_prior_steps) * kStepSeconds;
  }
  return score;
}

}  // namespace ivo::planner
