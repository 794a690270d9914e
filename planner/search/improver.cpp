#include "planner/search/improver.hpp"

#include <algorithm>

#include "planner/numeric/exponential.hpp"
#include "planner/search/work.hpp"

namespace ivo::planner {
namespace {

constexpr int kFirstRound = 4000;     // proposals; each round is twice as long as the one before
constexpr int kSpare = 4;             // legs kept beyond the end of a plan: what follows if it must see more
constexpr int kHottest = 400;         // a plan's cost over the first temperature, at least
constexpr int kHottestLegs = 13;      // the same, of one leg's share: a change touches a leg or two
constexpr double kLogCooling = -3.2;  // ln of the last temperature over the first
constexpr int kScoreEvery = 250;      // proposals, or a twelfth of all, between two exact scores

}  // namespace

bool Improver::open(const ImproverParameters& parameters) noexcept {
  parameters_ = parameters;
  agents_ = static_cast<int>(world_.bodies.size());
  has_best_ = false;
  learned_ = false;
  recalls_learned_ = false;
  proposals_ = 0;
  rng_ = Rng(parameters.seed);
  if (!pool_.open()) {
    return false;
  }
  open_field();
  open_judge();
  fill_tables();
  return true;
}

// Where waypoints may lie, for changes and for lanes.
void Improver::open_field() noexcept {
  const SegmentedMap& map = world_.map;
  const Bodies& bodies = world_.bodies;
  double widest_m = 0.0;
  double largest_m = 0.0;
  double most_swept = 0.0;  // m^2 in a second
  for (int m = 0; m < agents_; ++m) {
    widest_m = std::max(widest_m, bodies[index(m)].sight_radius_m);
    largest_m = std::max(largest_m, bodies[index(m)].footprint_radius_m);
    most_swept = std::max(most_swept, bodies[index(m)].sight_radius_m * world_.speeds_mps[index(m)]);
  }
  // Farther than the map is long is as good as that.
  const double border_m = std::min(std::max(largest_m, world_.clearance_m), map.width_m() + map.height_m());
  const RouteChange::Field field{.agents = agents_,
                                 .width = static_cast<std::int32_t>(map.width_m() * kTicksAMetre),
                                 .height = static_cast<std::int32_t>(map.height_m() * kTicksAMetre),
                                 .border = static_cast<std::int32_t>(border_m * kTicksAMetre) + 2,
                                 .sight = std::max(8, static_cast<int>(widest_m * kTicksAMetre))};
  change_.open(field);
  lane_team_.width = field.width;
  lane_team_.height = field.height;
  lane_team_.border = field.border;
  lane_team_.agents = agents_;
  for (int m = 0; m < agents_; ++m) {
    const double sight_m = bodies[index(m)].sight_radius_m;
    lane_team_.starts[index(m)] = pool_.place_of(m).spot;
    lane_team_.sight[index(m)] = std::max(1, static_cast<std::int32_t>(sight_m * kTicksAMetre));
    lane_team_.sweep[index(m)] =
        std::max(1, static_cast<std::int32_t>(sight_m * world_.speeds_mps[index(m)] / most_swept * 0x1p20));
  }
}

void Improver::open_judge() noexcept {
  std::array<SecondsAMetre, limits::kAgents> paces{};
  for (int m = 0; m < agents_; ++m) {
    paces[index(m)] = SecondsAMetre(1.0 / world_.speeds_mps[index(m)]);
  }
  judge_.open(world_.cells, world_.belief, paces, parameters_.max_unseen_mass);
  int work = 0;
  for (int m = 0; m < agents_; ++m) {
    judge_.set_start(m, pool_.make(m, pool_.place_of(m), pool_.place_of(m), work));
  }
}

void Improver::fill_tables() noexcept {
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
  int work = 1;
  if (restoring_ >= 0) {
    if (pool_.make_rows(work, rows + 1)) {
      (void)current_.legs[index(restored_agent_)].push_back({restoring_, false});
      restoring_ = -1;
      ++restored_;
    }
    return work;
  }
  const Waypoints& way = draft_[index(restored_agent_)];
  if (restored_ < way.size() && !current_.legs[index(restored_agent_)].full()) {
    restoring_ = pool_.begin(restored_agent_, way[restored_ - 1], way[restored_], work);
    if (restoring_ >= 0) {
      return work;
    }
    draft_broken_ = true;  // something stands in the way, or there is no room: what there is goes on
  }
  ++restored_agent_;
  restored_ = 1;
  if (restored_agent_ == agents_) {
    work += judge_.start(current_, Seconds{});
    phase_ = Phase::kJudgeFirst;
  }
  return work;
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

int Improver::propose() noexcept {
  int work = 0;
  if (change_.propose(current_, judged_, rng_, work)) {
    phase_ = Phase::kMake;
  } else {
    after_proposal();
  }
  return work;
}

int Improver::make(int rows) noexcept {
  int work = 1;
  if (!change_.make(work, rows + 1)) {
    after_proposal();
  } else if (change_.made()) {
    work += judge_.start(change_.candidate(), change_.changed_s());
    phase_ = Phase::kJudge;
  }
  return work;
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
    change_.reject();
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
  change_.accept(current_);
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

void Improver::remember() noexcept {
  remembered_cost_ = judged_.cost;
  remembered_complete_ = true;
  remembered_ = true;
  for (int m = 0; m < agents_; ++m) {
    Waypoints& way = memory_[index(m)];
    way.clear();
    (void)way.push_back(pool_.place_of(m));
    for (const Leg& leg : current_.legs[index(m)]) {
      (void)way.push_back(end_of(leg, pool_));
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
