#include "planner/search/colony.hpp"

#include <algorithm>

#include "planner/search/work.hpp"

namespace ivo::planner {
namespace {

// The first ant of the fast profile's first generations: a greedy one, for a complete plan early, then some that look
// ahead.
struct Scout {
  int moves = 1;
  double patience = 4.0;
};
constexpr std::array<Scout, 4> kScouts = {{{1, 4.0}, {3, 10.0}, {3, 4.0}, {2, 30.0}}};

int edges_of(const Tour& tour) noexcept {
  int edges = 1;
  for (const EdgePath& path : tour.paths) {
    edges += static_cast<int>(path.size());
  }
  return edges;
}

// A plan that needs no time would draw every ant for ever.
Mass cost_of(const Tour& tour) noexcept { return std::max(tour.cost.high, Mass(1)); }

}  // namespace

void Colony::start(const ColonyParameters& parameters) noexcept {
  parameters_ = parameters;
  trails_.start(world_.graph, parameters.rho, parameters.heuristic == Heuristic::kTsp ? parameters.beta : 0);
  ant_.open();
  scorer_.open(parameters.profile == Profile::kPaper);
  if (parameters.profile == Profile::kPaper) {
    scorer_.warm();
  }
  rng_ = Rng(parameters.seed);
  deposit_rng_ = Rng(~parameters.seed);
  generation_ = 0;
  bettered_ = 0;
  ants_done_ = 0;
  contending_ = 0;
  has_best_ = false;
  (void)begin_generation();
}

int Colony::begin_generation() noexcept {
  deposits_iteration_best_ = deposit_rng_.unit() < parameters_.iteration_best;
  return begin_ant();
}

int Colony::begin_ant() noexcept {
  phase_ = Phase::kAnt;
  AntParameters ant = parameters_.ant;
  if (parameters_.heuristic == Heuristic::kUnseen && ants_done_ == 0 && index(generation_) < kScouts.size()) {
    ant.looks_ahead = kScouts[index(generation_)].moves;
    ant.patience = kScouts[index(generation_)].patience;
  }
  ant_.start(ant, parameters_.heuristic, parameters_.beta);
  return 16;
}

int Colony::advance(int rows) noexcept {
  switch (phase_) {
    case Phase::kAnt:
      return ant_.done() ? end_ant() : ant_.advance(rng_, rows);
    case Phase::kScoreBest:
    case Phase::kScoreAnt:
      return scorer_.done() ? (phase_ == Phase::kScoreBest ? take_generation_best() : contend())
                            : scorer_.advance(rows);
    case Phase::kRaise:
    case Phase::kEvaporate:
    case Phase::kClamp:
      return sweep_trails(rows);
    case Phase::kDone:
      break;
  }
  return 0;
}

bool Colony::better(const Tour& a, const Tour& b) const noexcept {
  if (a.complete != b.complete) {
    return a.complete;
  }
  return a.complete ? a.cost.high < b.cost.low : a.unseen < b.unseen;
}

// Ants are ranked by Eq. 8 in both profiles; what is shown in the fast one is ranked by ET_c, as its improvement is.
bool Colony::better_to_show(const Tour& a, const Tour& b) const noexcept {
  if (parameters_.profile == Profile::kPaper || world_.belief.has_sub_priors || !a.complete || !b.complete) {
    return better(a, b);
  }
  return a.score.expected_time_continuous_s < b.score.expected_time_continuous_s;
}

void Colony::score(Tour& tour, Phase phase) noexcept {
  scorer_.start(tour, parameters_.ant.max_unseen_mass);
  phase_ = phase;
}

int Colony::end_ant() noexcept {
  Tour& tour = contenders_[index(contending_++)];
  ant_.finish(tour);
  if (world_.belief.has_sub_priors) {
    tour.cost = {Mass{}, Mass(1 << 20)};  // Eq. 8 says nothing of EST
  }
  ++ants_done_;
  return edges_of(tour) + contend();
}

// Those of the generation's ants that may be its best: as long as one can be told from the others by its bounds, none
// is scored. The earlier one where two are equal.
int Colony::contend() noexcept {
  drop_the_beaten();
  const bool ants_over = ants_done_ == parameters_.ants;
  if (contending_ == 1 && ants_over) {
    generation_best_.assign(contenders_[0]);
    return edges_of(generation_best_) + end_generation();
  }
  if (ants_over || contending_ == kContenders) {
    const auto by_low = [](const Tour& a, const Tour& b) {
      return a.scored != b.scored ? !a.scored : a.cost.low < b.cost.low;
    };
    score(*std::min_element(contenders_.begin(), contenders_.begin() + contending_, by_low), Phase::kScoreAnt);
    return contending_;
  }
  return begin_ant();
}

void Colony::drop_the_beaten() noexcept {
  int best = 0;
  for (int i = 1; i < contending_; ++i) {
    const Tour& a = contenders_[index(i)];
    const Tour& b = contenders_[index(best)];
    const bool ahead = a.complete != b.complete ? a.complete
                       : a.complete             ? a.cost.high < b.cost.high
                                                : a.unseen < b.unseen;
    best = ahead ? i : best;
  }
  // Where the best so far deposits, an ant matters only when it may be better than that.
  const bool must_beat_best = !deposits_iteration_best_ && has_best_ && best_.complete;
  const Tour& ahead = contenders_[index(best)];
  int kept = 0;
  for (int i = 0; i < contending_; ++i) {
    const Tour& tour = contenders_[index(i)];
    const bool beaten = !ahead.complete || !tour.complete || tour.cost.low >= ahead.cost.high ||
                        (must_beat_best && tour.cost.low >= best_.cost.high);
    if (i == best || !beaten) {
      if (kept != i) {
        contenders_[index(kept)].assign(tour);
      }
      ++kept;
    }
  }
  contending_ = kept;
}

int Colony::end_generation() noexcept {
  ants_done_ = 0;
  contending_ = 0;
  ++generation_;
  const Tour& tour = generation_best_;
  const bool may_be_best =
      !has_best_ || tour.complete != best_.complete || !tour.complete || tour.cost.low < best_.cost.low;
  if (!tour.scored && (may_be_best || deposits_iteration_best_)) {
    score(generation_best_, Phase::kScoreBest);
    return 1;
  }
  return take_generation_best();
}

int Colony::take_generation_best() noexcept {
  if (!has_best_ || (generation_best_.scored && better_to_show(generation_best_, best_))) {
    set_best(generation_best_);
  }
  if (generation_ >= parameters_.generations || best_.cost.high <= Mass{}) {
    phase_ = Phase::kDone;  // nothing is cheaper than a plan that sees everything from the starts
    return 1;
  }
  sweep_agent_ = 0;
  sweep_edge_ = 0;
  const bool stale = parameters_.restart_after > 0 && generation_ - bettered_ >= parameters_.restart_after;
  if (stale) {
    bettered_ = generation_;
  }
  phase_ = generation_ == 1 || stale ? Phase::kRaise : Phase::kEvaporate;
  return 1;
}

void Colony::set_best(const Tour& tour) noexcept {
  best_.assign(tour);
  has_best_ = true;
  bettered_ = generation_;
  trails_.set_limits(cost_of(best_));
}

void Colony::offer(const Tour& tour) noexcept {
  if (!has_best_ || better_to_show(tour, best_)) {
    set_best(tour);
  }
}

// To tau_max after generation 1; then evaporation, deposit, clamp: over all trails, some rows at a time.
int Colony::sweep_trails(int rows) noexcept {
  const Graph& graph = world_.graph;
  // A few trails to the unit.
  const Edge count = std::min<Edge>(rows * 3, graph.edges() - sweep_edge_);
  int work = 1;
  if (phase_ == Phase::kRaise) {
    trails_.raise_to_max(sweep_agent_, sweep_edge_, count);
    work += work::raised(count);
  } else if (phase_ == Phase::kEvaporate) {
    trails_.evaporate(sweep_agent_, sweep_edge_, count);
    work += work::evaporated(count);
  } else {
    trails_.clamp(sweep_agent_, sweep_edge_, count);
    work += work::clamped(count);
  }
  sweep_edge_ += count;
  if (sweep_edge_ < graph.edges()) {
    return work;
  }
  sweep_edge_ = 0;
  ++sweep_agent_;
  if (sweep_agent_ < graph.agents()) {
    return work;
  }
  sweep_agent_ = 0;
  if (phase_ == Phase::kRaise) {
    phase_ = Phase::kEvaporate;
    return work;
  }
  if (phase_ == Phase::kEvaporate) {
    phase_ = Phase::kClamp;
    return work + deposit();
  }
  return work + begin_generation();
}

int Colony::deposit() noexcept {
  const Tour& depositor = deposits_iteration_best_ ? generation_best_ : best_;
  const Trail amount = trails_.amount_for(cost_of(depositor));
  int work = 0;
  for (int m = 0; m < world_.graph.agents(); ++m) {
    for (const Edge e : depositor.paths[index(m)]) {
      trails_.deposit(m, e, amount);
      ++work;
    }
  }
  return work;
}

}  // namespace ivo::planner
