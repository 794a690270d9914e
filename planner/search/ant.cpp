#include "planner/search/ant.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "planner/search/expected_time.hpp"
#include "planner/search/first_sightings.hpp"
#include "planner/search/work.hpp"

namespace ivo::planner {
void Ant::start(const AntParameters& parameters, Heuristic heuristic, int beta) noexcept {
  parameters_ = parameters;
  heuristic_ = heuristic;
  beta_ = beta;
  if (++ant_number_ == 0) {
    visited_.fill(0);
    ant_number_ = 1;
  }
  unseen_ = world_.belief.whole;
  low_steps_ = high_steps_ = Mass{};
  last_new_s_ = Seconds{};
  second_wind_ = false;
  if (heuristic_ == Heuristic::kMts) {
    sectors_.start();
  }
  if (parameters.looks_ahead > 0) {
    lookahead_.start(parameters.looks_ahead, parameters.patience);
  }
  for (int m = 0; m < world_.graph.agents(); ++m) {
    at_[index(m)] = m;
    time_s_[index(m)] = Seconds{};
    retired_[index(m)] = false;
    paths_[index(m)].clear();
    visit(m);
  }
  cleared_ = 0;
  phase_ = Phase::kClear;
}

int Ant::advance(Rng& rng, int rows) noexcept {
  switch (phase_) {
    case Phase::kClear:
      return clear(rows);
    case Phase::kLookFromStarts:
      return look_from_starts(rows);
    case Phase::kChooseAgent:
      return choose_agent(rng);
    case Phase::kWeigh:
      return weigh(rows);
    case Phase::kLookAhead:
      return look_ahead(rows);
    case Phase::kChooseNode:
      return choose_node(rng);
    case Phase::kJump:
      return jump(rows);
    case Phase::kLookAtNode:
      return look_at_node(rows);
    case Phase::kLookAround:
      return look_around(rows);
    case Phase::kMove:
      return move(rows);
    case Phase::kDone:
      break;
  }
  return 0;
}

bool Ant::complete() const noexcept {
  return is_complete(to_double(unseen_) / to_double(world_.belief.whole), parameters_.max_unseen_mass);
}

// A new ant: what is seen is what has no mass, and what is in sight of the starts.
int Ant::clear(int rows) noexcept {
  if (heuristic_ == Heuristic::kMts && !sectors_.started()) {
    return sectors_.start_tiles(rows);
  }
  const SeenMap& unseen = world_.belief.without_mass;
  const int count = std::min(rows * work::kBytesCopied, unseen.bytes() - cleared_);
  seen_.copy(unseen, cleared_, count);
  cleared_ += count;
  const int work = 1 + work::bytes(count);
  if (cleared_ < unseen.bytes()) {
    return work;
  }
  agent_ = 0;
  walk_.begin(world_.sight.from_node(0, 0));
  phase_ = Phase::kLookFromStarts;
  return work;
}

int Ant::look_from_starts(int rows) noexcept {
  int work = 1;
  while (work <= rows) {
    if (!walk_.done()) {
      const ViewWalk::Part part = walk_.next(world_.sight, rows_at_once(rows - work + 1));
      work += look(part.swath, part.words, 0, 0);
    } else if (++agent_ < world_.graph.agents()) {
      walk_.begin(world_.sight.from_node(agent_, agent_));
    } else {
      phase_ = Phase::kChooseAgent;
      return work;
    }
  }
  return work;
}

// The agent whose path ends earliest with probability q, else one of the others; a single one left is taken without a
// draw.
int Ant::choose_agent(Rng& rng) noexcept {
  StaticVector<int, limits::kAgents> left;
  for (int m = 0; m < world_.graph.agents(); ++m) {
    if (!retired_[index(m)] && !left.push_back(m)) {
      break;
    }
  }
  if (left.empty() && parameters_.completes && !second_wind_ && !complete()) {
    second_wind_ = true;
    for (int m = 0; m < world_.graph.agents(); ++m) {
      retired_[index(m)] = paths_[index(m)].full();
    }
    return 1;
  }
  if (complete() || left.empty()) {
    phase_ = Phase::kDone;
    return 1;
  }
  std::size_t earliest = 0;
  for (std::size_t i = 1; i < left.size(); ++i) {
    if (time_s_[index(left[i])] < time_s_[index(left[earliest])]) {
      earliest = i;
    }
  }
  std::size_t chosen = earliest;
  if (left.size() > 1 && parameters_.looks_ahead == 0 && rng.unit() >= parameters_.shortest_first) {
    const auto other = static_cast<std::size_t>(rng.below(static_cast<int>(left.size()) - 1));
    chosen = other < earliest ? other : other + 1;
  }
  agent_ = left[chosen];
  if (second_wind_) {
    begin_jump();
    return 1;
  }
  if (parameters_.looks_ahead > 0) {
    lookahead_.begin(agent_, at_[index(agent_)]);
    phase_ = Phase::kLookAhead;
    return 1;
  }
  phase_ = heuristic_ == Heuristic::kTsp ? Phase::kChooseNode : Phase::kWeigh;
  if (heuristic_ == Heuristic::kMts) {
    return 1 + sectors_.begin(agent_, at_[index(agent_)]);
  }
  if (heuristic_ == Heuristic::kUnseen) {
    unseen_mass_.begin(agent_, at_[index(agent_)]);
  }
  return 1;
}

int Ant::weigh(int rows) noexcept {
  const bool sectors = heuristic_ == Heuristic::kMts;
  const int work = sectors ? sectors_.advance(rows) : unseen_mass_.advance(seen_, rows, [&](Edge e) {
    return in(world_.graph.open_to(e), agent_) && !visited(world_.graph.head(e));
  });
  if (sectors ? sectors_.done() : unseen_mass_.done()) {
    phase_ = Phase::kChooseNode;
  }
  return work;
}

int Ant::look_ahead(int rows) noexcept {
  const int work = lookahead_.advance(seen_, rows);
  if (!lookahead_.done()) {
    return work;
  }
  const Edge e = lookahead_.first_move();
  if (e < 0) {
    begin_jump();
    return work;
  }
  route_.clear();
  (void)route_.push_back(e);
  begin_move();
  return work;
}

Visibility Ant::visibility(Edge e) const noexcept {
  return heuristic_ == Heuristic::kMts ? sectors_.visibility(e, beta_) : unseen_mass_.visibility(e, beta_);
}

// Eq. 2 over the neighbours on which no agent of this ant has been.
int Ant::choose_node(Rng& rng) noexcept {
  const Graph& graph = world_.graph;
  const Node here = at_[index(agent_)];
  const Edge first = graph.first_edge(here);
  const Edge end = graph.end_edge(here);
  const int agent = agent_;
  const bool by_length = heuristic_ == Heuristic::kTsp;
  // First who may be chosen, without a branch that nobody can foresee; then their weights.
  std::size_t candidates = 0;
  for (Edge e = first; e < end; ++e) {
    candidates_[candidates] = e;
    candidates +=
        static_cast<std::size_t>(!visited(graph.head(e))) & static_cast<std::size_t>(in(graph.open_to(e), agent));
  }
  Weight sum{};
  for (std::size_t i = 0; i < candidates; ++i) {
    const Edge e = candidates_[i];
    sum += by_length ? trails_.attraction(agent, e) : trails_.attraction(agent, e, visibility(e));
    weights_[i] = sum;
  }
  const int work = work::choice(end - first) + (by_length ? 0 : work::visibilities(end - first));
  if (sum <= Weight{}) {
    begin_jump();
    return work;
  }
  const std::span<const Weight> sums(weights_.data(), candidates);
  const Weight draw = draw_below(sum, rng);
  // The first sum above the draw; an edge of no weight is never the first. Counted: a few dozen are quicker compared
  // than halved by guesses. A draw that rounds up to the sum takes the last.
  std::size_t chosen = 0;
  for (const Weight s : sums) {
    chosen += s <= draw ? 1U : 0U;
  }
  if (chosen == candidates) {
    chosen = static_cast<std::size_t>(std::lower_bound(sums.begin(), sums.end(), sum) - sums.begin());
  }
  route_.clear();
  (void)route_.push_back(candidates_[chosen]);
  begin_move();
  return work;
}

void Ant::begin_jump() noexcept {
  jump_.start(agent_, at_[index(agent_)]);
  jump_to_ = -1;
  jump_rate_ = Eta{};
  jump_within_m_ = std::numeric_limits<double>::infinity();
  phase_ = Phase::kJump;
}

// Without a candidate: to the nearest unvisited node that has unseen mass in sight, along the shortest path. The second
// time round any node will do, and so will an edge that begins there. Who looks ahead: of the nodes up to twice as far
// as the nearest that shows anything, to that which shows most for its way.
int Ant::jump(int rows) noexcept {
  const int work_before = jump_.work();
  const Node n = jump_.settle_next();
  const int work = work::settled(jump_.work() - work_before);
  if (n == JumpSearch::kCatchingUp) {
    return work;
  }
  if (n < 0 || (judges_jumps() && jump_.distance_m(n) > jump_within_m_)) {
    if (jump_to_ >= 0) {
      go_to(jump_to_);
    } else {
      retire();
    }
    return work;
  }
  if (!judges_jumps() && !second_wind_ && visited(n)) {
    return work;
  }
  jump_node_ = n;
  const SightView view = world_.sight.from_node(agent_, n);
  if (judges_jumps()) {
    shown_there_.begin(agent_, view);
  } else {
    walk_.begin(n == at_[index(agent_)] ? SightView{} : view);  // what is in sight from here has been seen
  }
  phase_ = Phase::kLookAtNode;
  return work + look_at_node(std::max(1, rows - work));
}

int Ant::look_at_node(int rows) noexcept {
  int work = 1;
  if (judges_jumps()) {
    work += shown_there_.advance(seen_, rows);
    if (shown_there_.done()) {
      judge_jump(jump_node_);
      phase_ = Phase::kJump;
    }
  } else if (finds_new(rows, work)) {
    go_to(jump_node_);
  } else if (walk_.done()) {
    jump_edge_ = world_.graph.first_edge(jump_node_) - 1;
    phase_ = second_wind_ ? Phase::kLookAround : Phase::kJump;
  }
  return work;
}

void Ant::judge_jump(Node n) noexcept {
  const Mass mass = shown_there_.mass();
  if (mass <= Mass{} || n == at_[index(agent_)]) {
    return;
  }
  const double way_m = jump_.distance_m(n);
  const Eta rate = eta_of(mass, way_m);
  jump_within_m_ = std::min(jump_within_m_, 2.0 * way_m);
  if (jump_to_ < 0 || rate > jump_rate_) {
    jump_to_ = n;
    jump_rate_ = rate;
  }
}

// One edge of the node after the other.
int Ant::look_around(int rows) noexcept {
  int work = 1;
  while (work <= rows) {
    if (!walk_.done()) {
      if (finds_new(rows, work)) {
        go_to(jump_node_, jump_edge_);
        return work;
      }
    } else if (++jump_edge_ == world_.graph.end_edge(jump_node_)) {
      phase_ = Phase::kJump;
      return work;
    } else if (++work; in(world_.graph.open_to(jump_edge_), agent_)) {
      walk_.begin(world_.sight.along_edge(agent_, jump_edge_));
    }
  }
  return work;
}

// Looks on along the walk, up to the first row that shows something new.
bool Ant::finds_new(int rows, int& work) noexcept {
  while (!walk_.done() && work <= rows) {
    const auto [swath, words, ends_swath] = walk_.next(world_.sight, rows_at_once(rows - work + 1));
    work += std::max(1, work::rows_searched(swath.rows));
    if (seen_.any_new(swath, words)) {
      return true;
    }
  }
  return false;
}

void Ant::go_to(Node n, Edge then) noexcept {
  route_.clear();
  if (then >= 0) {
    (void)route_.push_back(then);
  }
  for (Node step = n; jump_.edge_to(step) >= 0; step = jump_.before(step)) {
    (void)route_.push_back(jump_.edge_to(step));
  }
  begin_move();
}

void Ant::retire() noexcept {
  retired_[index(agent_)] = true;
  phase_ = Phase::kChooseAgent;
}

void Ant::begin_move() noexcept {
  walk_.begin(world_.sight.along_edge(agent_, route_.back()));
  shown_ = Mass{};
  phase_ = Phase::kMove;
  if (route_.size() == 1) {
    prefetch_next_choice(world_.graph.head(route_.back()));
  }
}

// While the ant looks along an edge, what it will choose from there comes nearer: on a large graph that is far away.
void Ant::prefetch_next_choice(Node n) const noexcept {
  const Edge first = world_.graph.first_edge(n);
  const int count = world_.graph.end_edge(n) - first;
  world_.graph.prefetch_choice(first, count);
  trails_.prefetch_choice(agent_, first, count);
  world_.sight.prefetch_moves(agent_, first, count);
}

int Ant::move(int rows) noexcept {
  const Edge e = route_.back();
  const int points = world_.sight.points(e);
  int work = 1;
  while (!walk_.done() && work <= rows) {
    const ViewWalk::Part part = walk_.next(world_.sight, rows_at_once(rows - work + 1));
    const Swath& swath = part.swath;
    work += look(swath, part.words, walk_.reversed() ? points - swath.last_point : swath.first_point,
                 walk_.reversed() ? points - swath.first_point : swath.last_point);
  }
  if (walk_.done()) {
    end_move(e);
    work += work::kMoveEnd;
  }
  return work;
}

// A cell that a swath adds is first seen after its first point (what that one shows, the swath before has shown) and at
// its last at the latest.
int Ant::look(const Swath& part, const std::uint64_t* words, int first_point, int last_point) noexcept {
  const Belief& belief = world_.belief;
  Mass gained{};
  int cells = 0;
  if (belief.alike > Mass{} && heuristic_ != Heuristic::kMts) {
    gained = belief.alike * seen_.look_and_count(part, words);
  } else {
    seen_.look(part, words, [&](int row, std::uint64_t fresh) {
      const Cell first = seen_.cell(row, part.first_byte, 0);
      cells += std::popcount(fresh);
      for_each_bit(fresh, [&](int bit) {
        gained += belief.mass[index(first + bit)];
        if (heuristic_ == Heuristic::kMts) {
          sectors_.take(first + bit);
        }
      });
    });
  }
  const int work = work::rows_shown(part.rows, cells) +
                   (heuristic_ == Heuristic::kMts ? work::tiles_taken(cells, sectors_.priors()) : 0);
  if (gained <= Mass{}) {
    return work;
  }
  unseen_ -= gained;
  shown_ += gained;
  if (last_point == 0) {
    return work;  // from a start, in step 0
  }
  const Edge e = route_.back();
  const Seconds begin_s = time_s_[index(agent_)];
  const Pace pace = world_.pace(agent_, e);
  const Seconds earliest_s = begin_s + after_points(pace, first_point + 1);
  low_steps_ += gained * (std::max(step_of(earliest_s), 1) - 1);
  high_steps_ += gained * (std::max(step_of(begin_s + after_points(pace, last_point)), 1) - 1);
  last_new_s_ = earliest_s;
  return work;
}

void Ant::end_move(Edge e) noexcept {
  const Seconds begin_s = time_s_[index(agent_)];
  // What another agent was to show first may have been seen by this one before: then it comes earlier than counted, by
  // no more than the two moves overlap in time. No more mass changes hands than the other's move showed.
  for (int other = 0; other < world_.graph.agents(); ++other) {
    const EdgePath& path = paths_[index(other)];
    for (std::size_t i = other == agent_ ? 0 : path.size(); i > 0; --i) {
      const Move& move = moves_[index(other)][i - 1];
      if (move.end_s <= begin_s) {
        break;
      }
      if (!may_share(other, path, i - 1, e)) {
        continue;
      }
      low_steps_ -= move.shown * (step_of(move.end_s) - step_of(begin_s));
    }
  }
  route_.pop_back();
  at_[index(agent_)] = world_.graph.head(e);
  time_s_[index(agent_)] = begin_s + world_.seconds_along(agent_, e);
  visit(at_[index(agent_)]);
  EdgePath& path = paths_[index(agent_)];
  ++moves_made_;
  moves_[index(agent_)][path.size()] = {time_s_[index(agent_)], shown_};
  if (!path.push_back(e) || path.full()) {
    retire();
  } else if (route_.empty()) {
    phase_ = Phase::kChooseAgent;
  } else {
    begin_move();
  }
}

// Whether two moves' sights can have a cell in common: by their bounding boxes.
bool Ant::may_share(int other, const EdgePath& path, std::size_t i, Edge e) const noexcept {
  const Graph& graph = world_.graph;
  const double reach_m = world_.sight.radius_m(other) + world_.sight.radius_m(agent_) + graph.spacing_m() * 1e-6;
  const Point a = graph.position(i == 0 ? other : graph.head(path[i - 1]));
  const Point b = graph.position(graph.head(path[i]));
  const Point c = graph.position(at_[index(agent_)]);
  const Point d = graph.position(graph.head(e));
  return std::max(std::min(a.x_m, b.x_m), std::min(c.x_m, d.x_m)) - reach_m <=
             std::min(std::max(a.x_m, b.x_m), std::max(c.x_m, d.x_m)) &&
         std::max(std::min(a.y_m, b.y_m), std::min(c.y_m, d.y_m)) - reach_m <=
             std::min(std::max(a.y_m, b.y_m), std::max(c.y_m, d.y_m));
}

CostInterval Ant::cost() const noexcept {
  Seconds last_s{};
  for (int m = 0; m < world_.graph.agents(); ++m) {
    last_s = std::max(last_s, time_s_[index(m)]);
  }
  // Sums of Eq. 8 in another order may differ in their last bits.
  const Mass margin(1e-6);
  return {low_steps_ + unseen_ * step_of(last_new_s_) - margin, high_steps_ + unseen_ * step_of(last_s) + margin};
}

void Ant::finish(Tour& tour) const noexcept {
  tour.scored = false;
  tour.complete = complete();
  tour.unseen = unseen_;
  tour.cost = cost();
  for (int m = 0; m < world_.graph.agents(); ++m) {
    tour.paths.resize(index(m) + 1);
    tour.paths[index(m)].assign(paths_[index(m)]);
  }
}

}  // namespace ivo::planner
