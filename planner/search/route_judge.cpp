#include "planner/search/route_judge.hpp"

#include <algorithm>

#include "planner/search/work.hpp"

namespace ivo::planner {
namespace {

// `of` times part / whole; whole above 0.
#if IVO_PLANNER_FIXED
template <int F>
Fixed<F> share(Fixed<F> of, Mass part, Mass whole) noexcept {
  const std::int64_t ratio = (part.raw() << 16) / whole.raw();
  return Fixed<F>::from_raw((of.raw() * ratio) >> 16);
}
#else
double share(double of, double part, double whole) noexcept { return of * (part / whole); }
#endif

MassTime judged(Mass mass, Seconds time_s) noexcept { return mass_time<kLongestJudged_s>(mass, time_s); }

}  // namespace

void RouteJudge::open(const Cells& cells, const Belief& belief, const std::array<SecondsAMetre, limits::kAgents>& paces,
                      double max_unseen_mass) noexcept {
  belief_ = &belief;
  agents_ = belief.agents;
  paces_ = paces;
  may_stay_unseen_ = max_unseen_mass;
  demand(0.0);
  horizon_s_ = Seconds(belief.sub_prior_steps);
  planes_.build(cells, belief, belief.mass);
  for (int m = 0; belief.has_sub_priors && m < agents_; ++m) {
    sub_planes_[index(m)].build(cells, belief, belief.sub_mass[index(m)]);
  }
  kept_count_ = 0;
  keep_every_s_ = Seconds{};
  done_ = true;
}

void RouteJudge::demand(double mass) noexcept {
  demanded_ = std::clamp(mass, 0.0, 0.75 * may_stay_unseen_);
  const Mass max_unseen = mass_from((may_stay_unseen_ - demanded_) * to_double(belief_->whole));
  if (max_unseen != max_unseen_) {
    max_unseen_ = max_unseen;
    kept_count_ = 0;  // some may lie behind where a plan is complete now
  }
}

// A state of the very moment of a change may lie behind it: a leg between two starts at one place takes no time.
int RouteJudge::start(const Route& route, Seconds changed_s) noexcept {
  route_ = &route;
  changed_s_ = changed_s;
  done_ = false;
  int from = kept_count_ - 1;
  while (from >= 0 && kept_[index(from)].time_s >= changed_s) {
    --from;
  }
  if (from >= 0) {
    state_ = kept_[index(from)];
    seen_.copy(kept_seen_[index(from)]);
  } else {
    state_ = State{.time_s = {}, .unseen = belief_->whole, .unfound = belief_->sub_whole, .cost = {}, .cursors = {}};
    seen_.copy(belief_->without_mass);
    for (int m = 0; m < agents_; ++m) {
      const Shown shown = look(m, pool_.part(pool_[starts_[index(m)]].first_part));
      state_.unseen -= shown.mass;
      state_.unfound -= shown.sub_mass;
    }
    if (state_.unseen <= max_unseen_) {
      end_complete({}, {}, {});
    }
  }
  next_kept_s_ = kept_count_ > 0 ? kept_[index(kept_count_ - 1)].time_s + keep_every_s_ : keep_every_s_;
  return work::kJudgement + work::bytes(seen_.bytes());
}

void RouteJudge::accept() noexcept {
  while (kept_count_ > 0 && kept_[index(kept_count_ - 1)].time_s >= changed_s_) {
    --kept_count_;
  }
  keep_every_s_ = judgement_.end_s / kKept;
}

int RouteJudge::advance(int rows) noexcept {
  int work = 1;
  while (!done_ && work <= rows) {
    const int agent = next_agent();
    if (agent < 0) {
      end_incomplete();
      break;
    }
    work += advance_agent(agent);
    if (!done_ && state_.time_s >= next_kept_s_ && state_.time_s < changed_s_ && kept_count_ < kKept) {
      keep_state();
      work += 15 + work::bytes(seen_.bytes());
    }
  }
  return work;
}

int RouteJudge::next_agent() const noexcept {
  int next = -1;
  for (int m = 0; m < agents_; ++m) {
    const Cursor& cursor = state_.cursors[index(m)];
    if (cursor.leg < static_cast<std::int32_t>(route_->legs[index(m)].size()) &&
        (next < 0 || cursor.time_s < state_.cursors[index(next)].time_s)) {
      next = m;
    }
  }
  return next;
}

// One part of one agent's leg.
int RouteJudge::advance_agent(int agent) noexcept {
  Cursor& cursor = state_.cursors[index(agent)];
  const Leg leg = route_->legs[index(agent)][index(cursor.leg)];
  const Segment& segment = pool_[leg.segment];
  if (cursor.part < 0) {
    cursor.part = leg.back ? segment.last_part : segment.first_part;
    cursor.parts_done = 0;
    cursor.leg_begin_s = cursor.time_s;
  }
  const Part& part = pool_.part(cursor.part);
  const Seconds whole_s = seconds_along(agent, leg.segment);
  const Seconds begin_s = cursor.time_s;
  const Seconds length_s = whole_s / segment.parts;
  const Shown shown = look(agent, part);
  if (state_.unseen - shown.mass <= max_unseen_) {
    end_complete(begin_s, length_s, shown);
    return shown.work + work::kJudgement;
  }
  const Seconds middle_s = begin_s + length_s / 2;
  if (belief_->has_sub_priors) {
    state_.cost += judged(shown.sub_mass, std::min(middle_s, horizon_s_));
    state_.unfound -= shown.sub_mass;
  } else {
    state_.cost += judged(shown.mass, middle_s);
  }
  state_.unseen -= shown.mass;
  ++cursor.parts_done;
  if (cursor.parts_done == segment.parts) {
    cursor.time_s = cursor.leg_begin_s + whole_s;
    cursor.part = -1;
    ++cursor.leg;
  } else {
    cursor.time_s = begin_s + length_s;
    cursor.part = leg.back ? part.before : part.next;
  }
  state_.time_s = std::max(state_.time_s, cursor.time_s);
  return shown.work + 8;
}

RouteJudge::Shown RouteJudge::look(int agent, const Part& part) noexcept {
  const Swath swath{.first_row = part.first_row,
                    .first_byte = part.first_byte,
                    .first_word = 0,
                    .rows = static_cast<std::int16_t>(part.rows),
                    .first_point = 0,
                    .last_point = 0};
  const bool sub_priors = belief_->has_sub_priors;
  if (!sub_priors && belief_->alike > Mass{}) {
    return {belief_->alike * seen_.look_and_count(swath, part.words.data()), Mass{}, work::rows_judged(part.rows, 0)};
  }
  Shown shown;
  const int planes = planes_.count() + (sub_priors ? 3 * sub_planes_[index(agent)].count() / 2 : 0);
  int read = 0;
  seen_.look(swath, part.words.data(), [&](int row, std::uint64_t fresh) {
    read += planes;
    shown.mass += planes_.of(row, part.first_byte, fresh);
    if (sub_priors) {
      shown.sub_mass += sub_planes_[index(agent)].of(row, part.first_byte, fresh);
    }
  });
  shown.work = work::rows_judged(part.rows, read);
  return shown;
}

void RouteJudge::keep_state() noexcept {
  kept_[index(kept_count_)] = state_;
  kept_seen_[index(kept_count_)].copy(seen_);
  ++kept_count_;
  next_kept_s_ = state_.time_s + keep_every_s_;
}

// The part that shows enough ends the plan: somewhere on the way along it.
void RouteJudge::end_complete(Seconds begin_s, Seconds length_s, const Shown& shown) noexcept {
  const Mass needed = state_.unseen - max_unseen_;
  const Seconds until_s = shown.mass > Mass{} ? share(length_s, needed, shown.mass) : Seconds{};
  const Seconds middle_s = begin_s + until_s / 2;
  judgement_.end_s = begin_s + until_s;
  if (belief_->has_sub_priors) {
    const Mass found = shown.mass > Mass{} ? share(shown.sub_mass, needed, shown.mass) : Mass{};
    judgement_.cost =
        state_.cost + judged(found, std::min(middle_s, horizon_s_)) + judged(state_.unfound - found, horizon_s_);
  } else {
    judgement_.cost = state_.cost + judged(needed, middle_s) + judged(max_unseen_, judgement_.end_s);
  }
  judgement_.complete = true;
  for (int m = 0; m < agents_; ++m) {
    judgement_.legs_used[index(m)] = state_.cursors[index(m)].leg + (state_.cursors[index(m)].part >= 0 ? 1 : 0);
  }
  done_ = true;
}

// What is missing costs more than any way of seeing it would.
void RouteJudge::end_incomplete() noexcept {
  const Seconds end_s = state_.time_s;
  const Mass missing = std::max(Mass{}, state_.unseen - max_unseen_);
  if (belief_->has_sub_priors) {
    judgement_.cost = state_.cost + judged(state_.unfound, horizon_s_) + judged(missing, horizon_s_) * 2;
  } else {
    judgement_.cost = state_.cost + judged(state_.unseen, end_s) * 3 / 2 + judged(missing, end_s) * 2;
  }
  judgement_.end_s = end_s;
  judgement_.complete = false;
  for (int m = 0; m < agents_; ++m) {
    judgement_.legs_used[index(m)] = static_cast<std::int32_t>(route_->legs[index(m)].size());
  }
  done_ = true;
}

}  // namespace ivo::planner
