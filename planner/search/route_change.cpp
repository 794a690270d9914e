#include "planner/search/route_change.hpp"

#include <algorithm>

#include "planner/search/work.hpp"

namespace ivo::planner {
namespace {

constexpr int kStretch = 12;  // waypoints that 2-opt reverses at most

template <std::size_t N>
bool insert_at(StaticVector<Leg, N>& legs, int i, Leg leg) noexcept {
  if (!legs.push_back(leg)) {
    return false;
  }
  std::rotate(legs.begin() + i, legs.end() - 1, legs.end());
  return true;
}

template <std::size_t N>
void erase(StaticVector<Leg, N>& legs, int first, int count) noexcept {
  std::copy(legs.begin() + first + count, legs.end(), legs.begin() + first);
  legs.resize(legs.size() - index(count));
}

template <std::size_t N>
void turn(StaticVector<Leg, N>& legs, int first, int end) noexcept {
  std::reverse(legs.begin() + first, legs.begin() + end);
  for (int i = first; i < end; ++i) {
    legs[index(i)] = legs[index(i)].turned();
  }
}

#if IVO_PLANNER_FIXED
constexpr Seconds kLater = Seconds(1 << 30);
#else
constexpr Seconds kLater = 1e300;
#endif

}  // namespace

bool RouteChange::propose(const Route& current, const Judgement& judged, Rng& rng, int& work) noexcept {
  current_ = &current;
  judged_ = &judged;
  rng_ = &rng;
  wishes_.clear();
  wish_ = 0;
  lost_.clear();
  changed_s_ = kLater;
  candidate_.assign(current, field_.agents);
  work += work::kProposal;
  for (int m = 0; m < field_.agents; ++m) {
    work += work::legs(size_of(current.legs[index(m)]));
  }
  const int agent = rng.below(field_.agents);
  const int draw = rng.below(100);
  return draw < 45   ? shift(agent)
         : draw < 60 ? add(agent)
         : draw < 75 ? drop(agent)
         : draw < 85 ? reverse(agent)
         : draw < 93 ? relocate(agent)
                     : exchange(agent);
}

bool RouteChange::make(int& work, int enough) noexcept {
  while (work < enough && !made()) {
    Wish& wish = wishes_[wish_];
    if (wish.wanted && wish.segment < 0) {
      wish.segment = pool_.begin(wish.agent, wish.from, wish.to, work);
      if (wish.segment < 0) {
        reject();
        return false;
      }
    } else if (!wish.wanted || pool_.make_rows(work, enough)) {
      ++wish_;
    }
  }
  if (made()) {
    fill_in(work);
  }
  return true;
}

void RouteChange::fill_in(int& work) noexcept {
  for (int m = 0; m < field_.agents; ++m) {
    for (Leg& leg : candidate_.legs[index(m)]) {
      if (leg.segment < 0) {
        leg.segment = wishes_[index(-1 - leg.segment)].segment;
      }
    }
    work += work::legs(size_of(candidate_.legs[index(m)])) / 2;
  }
}

void RouteChange::accept(Route& current) noexcept {
  current.assign(candidate_, field_.agents);
  for (const std::int32_t id : lost_) {
    pool_.release(id);
  }
}

void RouteChange::reject() noexcept {
  for (const Wish& wish : wishes_) {
    if (wish.segment >= 0) {
      pool_.release(wish.segment);
    }
  }
}

Place RouteChange::place(const Legs& legs, int agent, int i) const noexcept {
  if (i == 0) {
    return pool_.place_of(agent);
  }
  const Leg leg = legs[index(i - 1)];
  return leg.segment < 0 ? wishes_[index(-1 - leg.segment)].to : end_of(leg, pool_);
}

Seconds RouteChange::time_at(int agent, int leg) const noexcept {
  Seconds time_s{};
  for (int i = 0; i < leg; ++i) {
    time_s += judge_.seconds_along(agent, current_->legs[index(agent)][index(i)].segment);
  }
  return time_s;
}

// Changing legs that a plan does not come to changes nothing.
int RouteChange::reach(int agent) const noexcept {
  return std::min(size_of(current_->legs[index(agent)]), judged_->legs_used[index(agent)] + 2);
}

int RouteChange::pick_spread() noexcept {
  const int draw = rng_->below(4);
  return draw < 2 ? field_.sight / 7 : draw == 2 ? field_.sight / 2 : field_.sight * 3 / 2;
}

// Two sums of uniforms: a bell of about that spread; what would lie too near the border lies as near as it may.
Place RouteChange::near(const Place& centre, int spread) noexcept {
  const auto inside = [](int ticks, int low, int high) { return low < high ? std::clamp(ticks, low, high) : ticks; };
  const auto offset = [&] { return rng_->below(2 * spread + 1) + rng_->below(2 * spread + 1) - 2 * spread; };
  const int x = offset();
  const int y = offset();
  return {{inside(centre.spot.x + x, field_.border, field_.width - field_.border),
           inside(centre.spot.y + y, field_.border, field_.height - field_.border)},
          -1};
}

bool RouteChange::put(int agent, Legs& legs, int i, const Place& from, const Place& to) noexcept {
  if (from.spot == to.spot) {
    return false;
  }
  legs[index(i)] = {-1 - static_cast<std::int32_t>(wishes_.size()), false};
  return wishes_.push_back({agent, from, to, -1, true});
}

// Moves a waypoint.
bool RouteChange::shift(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  if (n == 0) {
    return false;
  }
  const int i = std::min(n, 1 + rng_->below(std::max(1, reach(agent))));
  const Place to = near(place(legs, agent, i), pick_spread());
  const Place before = place(legs, agent, i - 1);
  changed(time_at(agent, i - 1));
  lose(legs[index(i - 1)]);
  if (i == n) {
    return put(agent, legs, i - 1, before, to);
  }
  const Place after = place(legs, agent, i + 1);
  lose(legs[index(i)]);
  return put(agent, legs, i - 1, before, to) && put(agent, legs, i, to, after);
}

// Adds a waypoint beside a leg, or at the end.
bool RouteChange::add(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  const int i = std::min(n, rng_->below(reach(agent) + 1));
  const Place before = place(legs, agent, i);
  const int spread = rng_->below(2) == 0 ? field_.sight / 2 : field_.sight * 3 / 2;
  changed(time_at(agent, i));
  if (i == n) {
    return legs.push_back({}) && put(agent, legs, i, before, near(before, spread));
  }
  const Place after = place(legs, agent, i + 1);
  const int share = rng_->below(257);
  const Place between{{before.spot.x + (after.spot.x - before.spot.x) * share / 256,
                       before.spot.y + (after.spot.y - before.spot.y) * share / 256},
                      -1};
  const Place to = near(between, spread);
  lose(legs[index(i)]);
  return insert_at(legs, i, {}) && put(agent, legs, i, before, to) && put(agent, legs, i + 1, to, after);
}

bool RouteChange::drop(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  if (n < 2) {
    return false;
  }
  const int i = std::min(n, 1 + rng_->below(std::max(1, reach(agent))));
  const Place before = place(legs, agent, i - 1);
  changed(time_at(agent, i - 1));
  lose(legs[index(i - 1)]);
  if (i == n) {
    legs.pop_back();
    return true;
  }
  const Place after = place(legs, agent, i + 1);
  lose(legs[index(i)]);
  erase(legs, i, 1);
  return put(agent, legs, i - 1, before, after);
}

// 2-opt: a stretch the other way round.
bool RouteChange::reverse(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  if (n < 3) {
    return false;
  }
  const int i = 1 + rng_->below(std::max(1, reach(agent)));
  const int j = std::min(n, i + 1 + rng_->below(kStretch));
  if (i >= j) {
    return false;
  }
  const Place before = place(legs, agent, i - 1);
  const Place first = place(legs, agent, i);
  const Place last = place(legs, agent, j);
  changed(time_at(agent, i - 1));
  lose(legs[index(i - 1)]);
  if (j == n) {
    turn(legs, i, j);
    return put(agent, legs, i - 1, before, last);
  }
  const Place after = place(legs, agent, j + 1);
  lose(legs[index(j)]);
  turn(legs, i, j);
  return put(agent, legs, i - 1, before, last) && put(agent, legs, j, first, after);
}

// Or-opt: up to four waypoints to another place, of this agent's way or another's, either way round.
bool RouteChange::relocate(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  if (n < 3) {
    return false;
  }
  const int i = 1 + rng_->below(std::max(1, reach(agent)));
  const int j = i + rng_->below(4);
  if (j > n) {
    return false;
  }
  int other = rng_->below(2) == 0 ? agent : rng_->below(field_.agents);
  if (!pool_.alike(agent, other)) {
    other = agent;
  }
  const Place before = place(legs, agent, i - 1);
  Place first = place(legs, agent, i);
  Place last = place(legs, agent, j);
  changed(time_at(agent, i - 1));
  StaticVector<Leg, 8> moved;
  for (int k = i; k < j; ++k) {
    (void)moved.push_back(legs[index(k)]);
  }
  lose(legs[index(i - 1)]);
  if (j < n) {
    const Place after = place(legs, agent, j + 1);
    lose(legs[index(j)]);
    erase(legs, i, j - i + 1);
    if (!put(agent, legs, i - 1, before, after)) {
      return false;
    }
  } else {
    legs.resize(index(i - 1));
  }
  Legs& into = candidate_.legs[index(other)];
  const int size = size_of(into);
  const int at = std::min(size, rng_->below(std::min(size, judged_->legs_used[index(other)] + 2) + 1));
  changed(time_at(other, std::min(at, size_of(current_->legs[index(other)]))));
  const Place left = place(into, other, at);
  if (rng_->below(2) == 0) {
    turn(moved, 0, size_of(moved));
    std::swap(first, last);
  }
  if (into.size() + moved.size() + 2 > into.capacity()) {
    return false;
  }
  if (at == size) {
    (void)into.push_back({});
    for (const Leg& leg : moved) {
      (void)into.push_back(leg);
    }
    return put(other, into, at, left, first);
  }
  const Place right = place(into, other, at + 1);
  const Leg replaced = into[index(at)];
  for (const Leg& leg : moved) {
    (void)insert_at(into, at + 1 + static_cast<int>(&leg - moved.begin()), leg);
  }
  (void)insert_at(into, at + 1 + size_of(moved), {});
  take_out(replaced);
  return put(other, into, at, left, first) && put(other, into, at + 1 + size_of(moved), last, right);
}

// A leg that is no longer in the candidate: of the current route, or wished for a moment ago.
void RouteChange::take_out(const Leg& leg) noexcept {
  if (leg.segment < 0) {
    wishes_[index(-1 - leg.segment)].wanted = false;
  } else {
    lose(leg);
  }
}

// Two agents go on with each other's ways, from about the same time on.
bool RouteChange::exchange(int agent) noexcept {
  if (field_.agents < 2) {
    return false;
  }
  const int other = (agent + 1 + rng_->below(field_.agents - 1)) % field_.agents;
  if (!pool_.alike(agent, other)) {
    return false;
  }
  Legs& a = candidate_.legs[index(agent)];
  Legs& b = candidate_.legs[index(other)];
  const int i = std::min(size_of(a), rng_->below(reach(agent) + 1));
  const Seconds at_s = time_at(agent, i);
  int j = 0;
  for (Seconds time_s{}; j < size_of(b) && time_s < at_s; ++j) {
    time_s += judge_.seconds_along(other, b[index(j)].segment);
  }
  j = std::clamp(j + rng_->below(5) - 2, 0, std::min(size_of(b), reach(other)));
  const int a_left = size_of(a) - i;
  const int b_left = size_of(b) - j;
  if (a_left + b_left == 0 || index(i + b_left) > a.capacity() || index(j + a_left) > b.capacity()) {
    return false;
  }
  changed(at_s);
  changed(time_at(other, j));
  const Place from_a = place(a, agent, i);
  const Place from_b = place(b, other, j);
  const Place to_a = a_left > 0 ? place(a, agent, i + 1) : Place{};
  const Place to_b = b_left > 0 ? place(b, other, j + 1) : Place{};
  if (a_left > 0) {
    lose(a[index(i)]);
  }
  if (b_left > 0) {
    lose(b[index(j)]);
  }
  spare_.clear();
  for (int k = i; k < size_of(a); ++k) {
    (void)spare_.push_back(a[index(k)]);
  }
  a.resize(index(i));
  for (int k = j; k < size_of(b); ++k) {
    (void)a.push_back(b[index(k)]);
  }
  b.resize(index(j));
  for (const Leg& leg : spare_) {
    (void)b.push_back(leg);
  }
  return (b_left == 0 || put(agent, a, i, from_a, to_b)) && (a_left == 0 || put(other, b, j, from_b, to_a));
}

}  // namespace ivo::planner
