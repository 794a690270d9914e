#include "planner/search/expected_time.hpp"

#include <algorithm>

namespace ivo::planner {

void ExpectedTime::add(const Belief& belief, const FirstSightings& sightings, int first, int count) noexcept {
  ExpectedTime sums = *this;  // in registers
  sums.whole_ = belief.whole;
  for (int i = first; i < first + count; ++i) {
    const Cell c = belief.mass_cells[index(i)];
    if (!sightings.seen(c)) {
      continue;
    }
    const Sighting& s = sightings.of(c);
    const Mass p = belief.mass[index(c)];
    // Step 0 and step 1 are both credited from the first term of the sum on.
    const int steps = std::max(s.step, 1) - 1;
    sums.seen_mass_ += p;
    sums.mass_seconds_ += mass_time(p, s.time_s);
    sums.mass_steps_ += p * steps;
    if (belief.has_sub_priors) {
      const Mass q = belief.sub_mass[s.credited][index(c)];
      sums.sub_mass_ += q;
      sums.sub_mass_all_steps_ += q * steps;
      sums.sub_mass_steps_ += q * std::min(steps, belief.sub_prior_steps);
    }
    sums.extend_path(s.agent, s.time_s);
    if (s.credited != s.agent) {
      sums.extend_path(s.credited, s.credited_time_s);
    }
  }
  *this = sums;
}

Seconds ExpectedTime::horizon_s() const noexcept { return *std::max_element(path_end_s_.begin(), path_end_s_.end()); }

Mass ExpectedTime::unseen() const noexcept { return std::max(Mass{}, whole_ - seen_mass_); }

// sum over k = 1..N of [1 - P(k)]: a cell of step k counts in k - 1 terms, what stays unseen in all N.
Mass ExpectedTime::expected_time() const noexcept { return mass_steps_ + unseen() * step_of(horizon_s()); }

Mass ExpectedTime::expected_sub_prior_time(const Belief& belief) const noexcept {
  return sub_mass_steps_ + std::max(Mass{}, Mass(1) - sub_mass_) * belief.sub_prior_steps;
}

Mass ExpectedTime::expected_sub_prior_time_to_end() const noexcept {
  return sub_mass_all_steps_ + std::max(Mass{}, Mass(1) - sub_mass_) * step_of(horizon_s());
}

PlanScore ExpectedTime::score(const Belief& belief, double max_unseen_mass) const noexcept {
  PlanScore score;
  score.horizon_s = to_double(horizon_s());
  score.unseen_mass = to_double(unseen());
  score.complete = is_complete(score.unseen_mass, max_unseen_mass);
  score.expected_time_continuous_s = to_double(mass_seconds_) + score.unseen_mass * score.horizon_s;
  score.expected_time_s = to_double(expected_time()) * kStepSeconds;
  if (belief.has_sub_priors) {
    score.expected_sub_prior_time_s = to_double(expected_sub_prior_time(belief)) * kStepSeconds;
  }
  return score;
}

}  // namespace ivo::planner
