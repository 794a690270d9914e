#include "planner/search/expected_time.hpp"

#include <algorithm>

namespace ivo::planner {
namespace {

// Of Eq. 8's sum, those in which a cell of this step is unseen: steps 0 and 1 are both credited from the first on.
int terms_before(std::int32_t step) noexcept { return std::max(step, 1) - 1; }

}  // namespace

void ExpectedTime::add(const Belief& belief, const FirstSightings& sightings, int first, int count) noexcept {
  whole_ = belief.whole;
  sub_whole_ = belief.sub_whole;
  if (belief.has_sub_priors) {
    add_sub_priors(belief, sightings, first, count);
  }
  // In registers, and on the stack, where no other array can be taken for them.
  auto path_end_s = path_end_s_;
  const auto extend_path = [&](int agent, Seconds to_s) {
    if (to_s > path_end_s[index(agent)]) [[unlikely]] {  // a branch: stores would wait for one another
      path_end_s[index(agent)] = to_s;
    }
  };
  Mass seen_mass = seen_mass_;
  MassTime mass_seconds = mass_seconds_;
  Mass mass_steps = mass_steps_;
  for (const Cell c : belief.cells_with_mass().subspan(index(first), index(count))) {
    const Sighting s = sightings.of(c);
    if (!FirstSightings::seen(s)) {
      continue;
    }
    const Mass p = belief.mass[index(c)];
    seen_mass += p;
    mass_seconds += mass_time(p, s.time_s);
    mass_steps += p * terms_before(s.step);
    extend_path(s.agent, s.time_s);
    if (s.credited != s.agent) {
      extend_path(s.credited, sightings.credited_time_s(c));
    }
  }
  seen_mass_ = seen_mass;
  mass_seconds_ = mass_seconds;
  mass_steps_ = mass_steps;
  path_end_s_ = path_end_s;
}

void ExpectedTime::add_sub_priors(const Belief& belief, const FirstSightings& sightings, int first,
                                  int count) noexcept {
  for (const Cell c : belief.cells_with_mass().subspan(index(first), index(count))) {
    if (sightings.seen(c)) {
      const Sighting& s = sightings.of(c);
      const int steps = terms_before(s.step);
      const Mass q = belief.sub_mass[s.credited][index(c)];
      sub_mass_ += q;
      sub_mass_all_steps_ += q * steps;
      sub_mass_steps_ += q * std::min(steps, belief.sub_prior_steps);
    }
  }
}

Seconds ExpectedTime::horizon_s() const noexcept { return *std::max_element(path_end_s_.begin(), path_end_s_.end()); }

Mass ExpectedTime::unseen() const noexcept { return std::max(Mass{}, whole_ - seen_mass_); }

// sum over k = 1..N of [1 - P(k)]: a cell of step k counts in k - 1 terms, what stays unseen in all N.
Mass ExpectedTime::expected_time() const noexcept { return mass_steps_ + unseen() * step_of(horizon_s()); }

Mass ExpectedTime::expected_sub_prior_time(const Belief& belief) const noexcept {
  return sub_mass_steps_ + std::max(Mass{}, belief.sub_whole - sub_mass_) * belief.sub_prior_steps;
}

Mass ExpectedTime::expected_sub_prior_time_to_end() const noexcept {
  return sub_mass_all_steps_ + std::max(Mass{}, sub_whole_ - sub_mass_) * step_of(horizon_s());
}

// The cells' rounding out of it: shares of what they sum to.
PlanScore ExpectedTime::score(const Belief& belief, double max_unseen_mass) const noexcept {
  const double whole = to_double(belief.whole);
  PlanScore score;
  score.horizon_s = to_double(horizon_s());
  score.unseen_mass = to_double(unseen()) / whole;
  score.complete = is_complete(score.unseen_mass, max_unseen_mass);
  score.expected_time_continuous_s = to_double(mass_seconds_) / whole + score.unseen_mass * score.horizon_s;
  score.expected_time_s = to_double(expected_time()) / whole * kStepSeconds;
  if (belief.has_sub_priors) {
    score.expected_sub_prior_time_s =
        to_double(expected_sub_prior_time(belief)) / to_double(belief.sub_whole) * kStepSeconds;
  }
  return score;
}

}  // namespace ivo::planner
