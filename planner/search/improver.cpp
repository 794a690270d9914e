#include "planner/search/improver.hpp"

#include <algorithm>

#include "planner/numeric/exponential.hpp"
#include "planner/search/work.hpp"

namespace ivo::planner {
namespace {

constexpr int kFirstRound = 4000;     // proposals; each round is twice as long as the one before
constexpr int kStretch = 12;          // waypoints that 2-opt reverses at most
constexpr int kSpare = 4;             // legs kept beyond the end of a plan: what follows if it must see more
constexpr int kHottest = 400;         // a plan's cost over the first temperature, at least
constexpr int kHottestLegs = 13;      // the same, of one leg's share: a change touches a leg or two
constexpr double kLogCooling = -3.2;  // ln of the last temperature over the first
constexpr int kScoreEvery = 250;      // proposals, or a twelfth of all, between two exact scores

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

template <std::size_t N>
int size_of(const StaticVector<Leg, N>& legs) noexcept {
  return static_cast<int>(legs.size());
}

#if IVO_PLANNER_FIXED
constexpr Seconds kLater = Seconds(1 << 30);
#else
constexpr Seconds kLater = 1e300;
#endif

}  // namespace

bool Improver::open(const ImproverParameters& parameters) noexcept {
  const SegmentedMap& map = world_.map;
  const Bodies& bodies = world_.bodies;
  parameters_ = parameters;
  agents_ = static_cast<int>(bodies.size());
  has_best_ = false;
  learned_ = false;
  recalls_learned_ = false;
  proposals_ = 0;
  rng_ = Rng(parameters.seed);
  if (!pool_.open()) {
    return false;
  }
  double widest_m = 0.0;
  double largest_m = 0.0;
  double most_swept = 0.0;  // m^2 in a second
  std::array<SecondsAMetre, limits::kAgents> paces{};
  for (int m = 0; m < agents_; ++m) {
    paces[index(m)] = SecondsAMetre(1.0 / world_.speeds_mps[index(m)]);
    widest_m = std::max(widest_m, bodies[index(m)].sight_radius_m);
    largest_m = std::max(largest_m, bodies[index(m)].footprint_radius_m);
    most_swept = std::max(most_swept, bodies[index(m)].sight_radius_m * world_.speeds_mps[index(m)]);
  }
  // Farther than the map is long is as good as that.
  const double border_m = std::min(std::max(largest_m, world_.clearance_m), map.width_m() + map.height_m());
  right_ticks_ = static_cast<std::int32_t>(map.width_m() * kTicksAMetre);
  top_ticks_ = static_cast<std::int32_t>(map.height_m() * kTicksAMetre);
  border_ticks_ = static_cast<std::int32_t>(border_m * kTicksAMetre) + 2;
  sight_ticks_ = std::max(8, static_cast<int>(widest_m * kTicksAMetre));
  lane_team_.width = right_ticks_;
  lane_team_.height = top_ticks_;
  lane_team_.border = border_ticks_;
  lane_team_.agents = agents_;
  for (int m = 0; m < agents_; ++m) {
    const double sight_m = bodies[index(m)].sight_radius_m;
    lane_team_.starts[index(m)] = pool_.place_of(m).spot;
    lane_team_.sight[index(m)] = std::max(1, static_cast<std::int32_t>(sight_m * kTicksAMetre));
    lane_team_.sweep[index(m)] =
        std::max(1, static_cast<std::int32_t>(sight_m * world_.speeds_mps[index(m)] / most_swept * 0x1p20));
  }
  judge_.open(world_.cells, world_.belief, paces, parameters.max_unseen_mass);
  for (int m = 0; m < agents_; ++m) {
    judge_.set_start(m, pool_.make(m, pool_.place_of(m), pool_.place_of(m), work_));
  }
  // E of exp(-E) = u: a worse plan is kept when it is worse by less than E temperatures (Metropolis et al. 1953).
  for (std::size_t i = 0; i < patience_.size(); ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(patience_.size());
    double low = 0.0;
    double high = 8.0;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (exp_negative(-middle) > u ? low : high) = middle;
    }
    patience_[i] = static_cast<std::int32_t>(low * 256.0 + 0.5);
  }
  for (std::size_t i = 0; i < cooling_.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(cooling_.size() - 1);
    cooling_[i] = static_cast<std::int32_t>(exp_negative(kLogCooling * share) * 65536.0 + 0.5);
  }
  return true;
}

void Improver::start(const Tour& tour) noexcept {
  for (int m = 0; m < agents_; ++m) {
    Waypoints& way = draft_[index(m)];
    way.clear();
    (void)way.push_back(pool_.place_of(m));
    for (const Edge e : tour.paths[index(m)]) {
      (void)way.push_back(pool_.place_of(world_.graph.head(e)));
    }
    current_.legs[index(m)].clear();
  }
  drafts_ = 0;
  has_best_ = false;
  best_score_ = tour.score;
  remembered_ = false;
  remembered_complete_ = false;
  remembered_cost_ = MassTime{};
  round_ = 0;
  round_length_ = kFirstRound;
  round_done_ = 0;
  scored_at_ = 0;
  make_current();
}

// A lane plan to begin with instead, if it is the better one.
void Improver::draft_lanes() noexcept {
  for (int m = 0; m < agents_; ++m) {
    Waypoints& way = draft_[index(m)];
    way.clear();
    (void)way.push_back(pool_.place_of(m));
    fill_lanes(lane_team_, m, drafts_ - 1, lanes_);
    for (const Spot spot : lanes_) {
      if (!(spot == way.back().spot)) {
        (void)way.push_back({spot, -1});
      }
    }
  }
  make_current();
}

void Improver::recall() noexcept {
  recalls_learned_ = learned_;
  if (learned_) {
    learned_ = false;
    for (int m = 0; m < agents_; ++m) {
      memory_[index(m)].assign(best_[index(m)]);
    }
  }
  for (int m = 0; m < agents_; ++m) {
    draft_[index(m)].assign(memory_[index(m)]);
  }
  make_current();
}

// The draft becomes the current route, a leg a part.
void Improver::make_current() noexcept {
  for (int m = 0; m < agents_; ++m) {
    Legs& legs = current_.legs[index(m)];
    for (const Leg& leg : legs) {
      pool_.release(leg.segment);
    }
    legs.clear();
  }
  restored_agent_ = 0;
  restored_ = 1;
  restoring_ = -1;
  draft_broken_ = false;
  phase_ = Phase::kRestore;
}

int Improver::restore_leg(int rows) noexcept {
  work_ = 1;
  if (restoring_ >= 0) {
    if (pool_.make_rows(work_, rows + 1)) {
      (void)current_.legs[index(restored_agent_)].push_back({restoring_, false});
      restoring_ = -1;
      ++restored_;
    }
    return work_;
  }
  const Waypoints& way = draft_[index(restored_agent_)];
  if (restored_ < way.size() && !current_.legs[index(restored_agent_)].full()) {
    restoring_ = pool_.begin(restored_agent_, way[restored_ - 1], way[restored_], work_);
    if (restoring_ >= 0) {
      return work_;
    }
    draft_broken_ = true;  // something stands in the way, or there is no room: what there is goes on
  }
  ++restored_agent_;
  restored_ = 1;
  if (restored_agent_ == agents_) {
    work_ += judge_.start(current_, Seconds{});
    phase_ = Phase::kJudgeFirst;
  }
  return work_;
}

int Improver::advance(int rows) noexcept {
  int work = 0;
  switch (phase_) {
    case Phase::kRestore:
      work = restore_leg(rows);
      break;
    case Phase::kJudgeFirst:
    case Phase::kJudge:
      work = judge_.done() ? settle() : judge_.advance(rows);
      break;
    case Phase::kPropose:
      work = propose();
      break;
    case Phase::kMake:
      work = make(rows);
      break;
    case Phase::kScore:
      work = scorer_.done() ? take_score() : scorer_.advance(rows);
      break;
  }
  return work;
}

Place Improver::place(const Legs& legs, int agent, int i) const noexcept {
  if (i == 0) {
    return pool_.place_of(agent);
  }
  const Leg leg = legs[index(i - 1)];
  if (leg.segment < 0) {
    return wishes_[index(-1 - leg.segment)].to;
  }
  return leg.back ? pool_[leg.segment].from : pool_[leg.segment].to;
}

Seconds Improver::time_at(int agent, int leg) const noexcept {
  Seconds time_s{};
  for (int i = 0; i < leg; ++i) {
    time_s += judge_.seconds_along(agent, current_.legs[index(agent)][index(i)].segment);
  }
  return time_s;
}

// Changing legs that a plan does not come to changes nothing.
int Improver::reach(int agent) const noexcept {
  return std::min(size_of(current_.legs[index(agent)]), judged_.legs_used[index(agent)] + 2);
}

int Improver::pick_spread() noexcept {
  const int draw = rng_.below(4);
  return draw < 2 ? sight_ticks_ / 7 : draw == 2 ? sight_ticks_ / 2 : sight_ticks_ * 3 / 2;
}

// Two sums of uniforms: a bell of about that spread; what would lie too near the border lies as near as it may.
Place Improver::near(const Place& centre, int spread) noexcept {
  const auto inside = [](int ticks, int low, int high) { return low < high ? std::clamp(ticks, low, high) : ticks; };
  const auto offset = [&] { return rng_.below(2 * spread + 1) + rng_.below(2 * spread + 1) - 2 * spread; };
  const int x = offset();
  const int y = offset();
  return {{inside(centre.spot.x + x, border_ticks_, right_ticks_ - border_ticks_),
           inside(centre.spot.y + y, border_ticks_, top_ticks_ - border_ticks_)},
          -1};
}

bool Improver::put(int agent, Legs& legs, int i, const Place& from, const Place& to) noexcept {
  if (from.spot == to.spot) {
    return false;
  }
  legs[index(i)] = {-1 - static_cast<std::int32_t>(wishes_.size()), false};
  return wishes_.push_back({agent, from, to, -1, true});
}

// The segments that the candidate needs, a part at a time.
int Improver::make(int rows) noexcept {
  work_ = 1;
  while (work_ <= rows && wish_ < wishes_.size()) {
    Wish& wish = wishes_[wish_];
    if (wish.wanted && wish.segment < 0) {
      wish.segment = pool_.begin(wish.agent, wish.from, wish.to, work_);
      if (wish.segment < 0) {
        reject();
        after_proposal();
        return work_;
      }
    } else if (!wish.wanted || pool_.make_rows(work_, rows + 1)) {
      ++wish_;
    }
  }
  if (wish_ == wishes_.size()) {
    fill_in();
    work_ += judge_.start(candidate_, changed_s_);
    phase_ = Phase::kJudge;
  }
  return work_;
}

void Improver::fill_in() noexcept {
  for (int m = 0; m < agents_; ++m) {
    for (Leg& leg : candidate_.legs[index(m)]) {
      if (leg.segment < 0) {
        leg.segment = wishes_[index(-1 - leg.segment)].segment;
      }
    }
    work_ += work::legs(size_of(candidate_.legs[index(m)])) / 2;
  }
}

int Improver::propose() noexcept {
  wishes_.clear();
  wish_ = 0;
  lost_.clear();
  changed_s_ = kLater;
  work_ = work::kProposal;
  candidate_.assign(current_, agents_);
  const int agent = rng_.below(agents_);
  const int draw = rng_.below(100);
  const bool sound = draw < 45   ? shift(agent)
                     : draw < 60 ? add(agent)
                     : draw < 75 ? drop(agent)
                     : draw < 85 ? reverse(agent)
                     : draw < 93 ? relocate(agent)
                                 : exchange(agent);
  for (int m = 0; m < agents_; ++m) {
    work_ += work::legs(size_of(current_.legs[index(m)]));
  }
  if (sound) {
    phase_ = Phase::kMake;
  } else {
    reject();
    after_proposal();
  }
  return work_;
}

// Moves a waypoint.
bool Improver::shift(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  if (n == 0) {
    return false;
  }
  const int i = std::min(n, 1 + rng_.below(std::max(1, reach(agent))));
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
bool Improver::add(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  const int i = std::min(n, rng_.below(reach(agent) + 1));
  const Place before = place(legs, agent, i);
  const int spread = rng_.below(2) == 0 ? sight_ticks_ / 2 : sight_ticks_ * 3 / 2;
  changed(time_at(agent, i));
  if (i == n) {
    return legs.push_back({}) && put(agent, legs, i, before, near(before, spread));
  }
  const Place after = place(legs, agent, i + 1);
  const int share = rng_.below(257);
  const Place between{{before.spot.x + (after.spot.x - before.spot.x) * share / 256,
                       before.spot.y + (after.spot.y - before.spot.y) * share / 256},
                      -1};
  const Place to = near(between, spread);
  lose(legs[index(i)]);
  return insert_at(legs, i, {}) && put(agent, legs, i, before, to) && put(agent, legs, i + 1, to, after);
}

bool Improver::drop(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  if (n < 2) {
    return false;
  }
  const int i = std::min(n, 1 + rng_.below(std::max(1, reach(agent))));
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
bool Improver::reverse(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  if (n < 3) {
    return false;
  }
  const int i = 1 + rng_.below(std::max(1, reach(agent)));
  const int j = std::min(n, i + 1 + rng_.below(kStretch));
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
bool Improver::relocate(int agent) noexcept {
  Legs& legs = candidate_.legs[index(agent)];
  const int n = size_of(legs);
  if (n < 3) {
    return false;
  }
  const int i = 1 + rng_.below(std::max(1, reach(agent)));
  const int j = i + rng_.below(4);
  if (j > n) {
    return false;
  }
  int other = rng_.below(2) == 0 ? agent : rng_.below(agents_);
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
  const int at = std::min(size, rng_.below(std::min(size, judged_.legs_used[index(other)] + 2) + 1));
  changed(time_at(other, std::min(at, size_of(current_.legs[index(other)]))));
  const Place left = place(into, other, at);
  if (rng_.below(2) == 0) {
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
void Improver::take_out(const Leg& leg) noexcept {
  if (leg.segment < 0) {
    wishes_[index(-1 - leg.segment)].wanted = false;
  } else {
    lose(leg);
  }
}

// Two agents go on with each other's ways, from about the same time on.
bool Improver::exchange(int agent) noexcept {
  if (agents_ < 2) {
    return false;
  }
  const int other = (agent + 1 + rng_.below(agents_ - 1)) % agents_;
  if (!pool_.alike(agent, other)) {
    return false;
  }
  Legs& a = candidate_.legs[index(agent)];
  Legs& b = candidate_.legs[index(other)];
  const int i = std::min(size_of(a), rng_.below(reach(agent) + 1));
  const Seconds at_s = time_at(agent, i);
  int j = 0;
  for (Seconds time_s{}; j < size_of(b) && time_s < at_s; ++j) {
    time_s += judge_.seconds_along(other, b[index(j)].segment);
  }
  j = std::clamp(j + rng_.below(5) - 2, 0, std::min(size_of(b), reach(other)));
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

// A route has been judged.
int Improver::settle() noexcept {
  const Judgement& judgement = judge_.judgement();
  if (phase_ == Phase::kJudgeFirst) {
    judged_ = judgement;
    judge_.accept();
    if (recalls_learned_) {
      recalls_learned_ = false;
      remembered_cost_ = judged_.cost;
      remembered_complete_ = judged_.complete;
    }
    return drafts_ <= kLanePlans ? take_draft() : begin_round();
  }
  const MassTime worse = judgement.cost - judged_.cost;
  int work = work::kJudgement;
  if (worse <= MassTime{} || worse < temperature_ / 256 * patience_[index(rng_.below(256))]) {
    accept();
    for (int m = 0; m < agents_; ++m) {
      work += work::legs(size_of(current_.legs[index(m)]));
    }
  } else {
    reject();
  }
  after_proposal();
  return work;
}

// Of the drafts the best is improved.
int Improver::take_draft() noexcept {
  const bool better = judged_.complete != remembered_complete_ ? judged_.complete : judged_.cost < remembered_cost_;
  if (drafts_ == 0 || (better && !draft_broken_)) {
    remember();
    remembered_complete_ = judged_.complete;
  }
  ++drafts_;
  if (drafts_ <= kLanePlans) {
    draft_lanes();
  } else {
    recall();
  }
  return 1;
}

void Improver::accept() noexcept {
  judged_ = judge_.judgement();
  judge_.accept();
  current_.assign(candidate_, agents_);
  for (const std::int32_t id : lost_) {
    pool_.release(id);
  }
  for (int m = 0; m < agents_; ++m) {
    Legs& legs = current_.legs[index(m)];
    while (size_of(legs) > judged_.legs_used[index(m)] + kSpare) {
      pool_.release(legs.back().segment);
      legs.pop_back();
    }
  }
  if (judged_.complete && (!remembered_complete_ || judged_.cost < remembered_cost_)) {
    remember();
  }
}

void Improver::reject() noexcept {
  for (const Wish& wish : wishes_) {
    if (wish.segment >= 0) {
      pool_.release(wish.segment);
    }
  }
}

void Improver::remember() noexcept {
  remembered_cost_ = judged_.cost;
  remembered_complete_ = true;
  remembered_ = true;
  for (int m = 0; m < agents_; ++m) {
    Waypoints& way = memory_[index(m)];
    const Legs& legs = current_.legs[index(m)];
    way.clear();
    for (int i = 0; i <= size_of(legs); ++i) {
      (void)way.push_back(place(legs, m, i));
    }
  }
}

void Improver::after_proposal() noexcept {
  ++proposals_;
  ++round_done_;
  const bool round_over = round_done_ >= round_length_;
  const std::int64_t wait = std::max<std::int64_t>(kScoreEvery, proposals_ / 12);
  if (remembered_ && (round_over || proposals_ - scored_at_ >= wait)) {
    start_score();
    return;
  }
  if (round_over) {
    ++round_;
    recall();
    return;
  }
  set_temperature();
  phase_ = Phase::kPropose;
}

int Improver::begin_round() noexcept {
  round_length_ = kFirstRound << std::min(round_, 16);
  round_done_ = 0;
  int legs = 0;
  for (int m = 0; m < agents_; ++m) {
    legs += size_of(current_.legs[index(m)]);
  }
  const int parts = std::max(kHottest, kHottestLegs * legs);
  hottest_ = judged_.cost / (round_ == 0 ? parts : 2 * parts);
  set_temperature();
  phase_ = Phase::kPropose;
  return 1;
}

void Improver::set_temperature() noexcept {
  const auto stage = static_cast<std::size_t>(std::int64_t{round_done_} * 64 / round_length_);
  const std::int32_t cooling = cooling_[stage] / 256;  // 8 bits behind the point
  temperature_ = hottest_ / 256 * cooling;
}

void Improver::start_score() noexcept {
  remembered_ = false;
  scored_at_ = proposals_;
  StaticVector<WaypointPath, limits::kAgents> paths;
  for (int m = 0; m < agents_; ++m) {
    auto& points = points_[index(m)];
    points.clear();
    for (const Place& p : memory_[index(m)]) {
      (void)points.push_back(pool_.point_at(p));
    }
    (void)paths.push_back({points.span(), world_.speeds_mps[index(m)], world_.sight.radius_m(m)});
  }
  scorer_.start(world_.cells, world_.belief, paths.span(), parameters_.max_unseen_mass);
  phase_ = Phase::kScore;
}

bool Improver::better(const PlanScore& a, const PlanScore& b) const noexcept {
  if (a.complete != b.complete) {
    return a.complete;
  }
  if (!a.complete) {
    return a.unseen_mass < b.unseen_mass;
  }
  return world_.belief.has_sub_priors ? a.expected_sub_prior_time_s < b.expected_sub_prior_time_s
                                      : a.expected_time_continuous_s < b.expected_time_continuous_s;
}

void Improver::learn_from(const Improver& other) noexcept {
  if (!other.has_best_ || !better(other.best_score_, best_score_)) {
    return;
  }
  has_best_ = true;
  best_score_ = other.best_score_;
  learned_ = true;
  for (int m = 0; m < agents_; ++m) {
    best_[index(m)].assign(other.best_[index(m)]);
    best_end_s_[index(m)] = other.best_end_s_[index(m)];
  }
}

// The plan is shown only when it is better by the exact score. Where that finds more unseen than the judge does, the
// judge asks for more from then on.
int Improver::take_score() noexcept {
  PlanScore score = scorer_.score();
  score.expected_sub_prior_time_own_s = 0.0;  // not asked for: as MMAS's own plans have it
  int work = 1;
  if (better(score, best_score_)) {
    has_best_ = true;
    best_score_ = score;
    for (int m = 0; m < agents_; ++m) {
      best_[index(m)].assign(memory_[index(m)]);
      best_end_s_[index(m)] = scorer_.path_end_s(m);
      work += static_cast<int>(best_[index(m)].size());
    }
  }
  const double excess = score.unseen_mass - parameters_.max_unseen_mass;
  if (score.complete) {
    judge_.demand(judge_.demanded() + excess / 4);
  } else if (remembered_complete_) {
    judge_.demand(judge_.demanded() + excess);
    recall();
    recalls_learned_ = true;
    return work;
  }
  if (round_done_ >= round_length_) {
    ++round_;
    recall();
  } else {
    set_temperature();
    phase_ = Phase::kPropose;
  }
  return work;
}

}  // namespace ivo::planner
