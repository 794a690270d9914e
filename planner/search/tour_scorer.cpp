#include "planner/search/tour_scorer.hpp"

#include <algorithm>
#include <bit>

#include "planner/search/work.hpp"

namespace ivo::planner {

void TourScorer::start(Tour& tour, double max_unseen_mass) noexcept {
  tour_ = &tour;
  max_unseen_mass_ = max_unseen_mass;
  expected_.clear();
  phase_ = Phase::kClear;
  row_ = 0;
}

int TourScorer::advance(int rows) noexcept {
  switch (phase_) {
    case Phase::kClear:
      return clear(rows);
    case Phase::kReplay:
      return replay(rows);
    case Phase::kSum:
      return sum(rows);
    case Phase::kDone:
      break;
  }
  return 0;
}

void TourScorer::warm() noexcept {
  const Graph& graph = world_.graph;
  for (int m = 0; m < graph.agents(); ++m) {
    for (Node n = 0; n < graph.nodes(); ++n) {
      for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
        if (!in(graph.open_to(e), m) || events_.ready(m, e)) {
          continue;
        }
        if (!events_.has_room_for(m, e)) {
          return;
        }
        while (!events_.ready(m, e)) {
          (void)events_.prepare(m, n, e, 1 << 16);
        }
      }
    }
  }
}

int TourScorer::clear(int rows) noexcept {
  using work::kCellsForgotten;
  const int count = std::min(rows * kCellsForgotten, world_.cells.count() - row_);
  sightings_.clear(row_, count);
  row_ += count;
  if (row_ == world_.cells.count()) {
    phase_ = Phase::kReplay;
    begin_agent(0);
  }
  return count / kCellsForgotten + 1;
}

int TourScorer::replay(int rows) noexcept {
  if (!from_start_.done()) {
    return look_from_start(rows);
  }
  if (edge_ == tour_->paths[index(agent_)].size()) {
    begin_agent(agent_ + 1);
    return 1;
  }
  const Edge e = tour_->paths[index(agent_)][edge_];
  if (!events_.ready(agent_, e)) {
    return events_.prepare(agent_, at_, e, rows);
  }
  const auto events = events_.along(agent_, e);
  int work = 3;
  if (row_ == 0) {
    work += time_points(e);
  }
  const int end = std::min(static_cast<int>(events.size()), row_ + rows);
  const int count = end - row_;
  const int taken = sightings_.taken();
  const int agent = agent_;
  for (int i = row_; i < end; ++i) {
    const SightEvent event = events[index(i)];
    const Instant& instant = instants_[index(event.point())];
    (void)sightings_.see(event.cell(), agent, instant.time_s, instant.step);
  }
  row_ = end;
  work += work::events_replayed(count, sightings_.taken() - taken);
  if (row_ == static_cast<int>(events.size())) {
    time_s_ += world_.seconds_along(agent_, e);
    at_ = world_.graph.head(e);
    ++edge_;
    row_ = 0;
  }
  return work;
}

// When the edge's sight points are passed: an edge has ten times as many cells as points.
int TourScorer::time_points(Edge e) noexcept {
  const Pace pace = world_.pace(agent_, e);
  const int points = world_.sight.points(e);
  for (int k = 0; k <= points; ++k) {
    const Seconds time_s = time_s_ + after_points(pace, k);
    instants_[index(k)] = {time_s, step_of(time_s)};
  }
  return work::points_timed(points + 1);
}

void TourScorer::begin_agent(int agent) noexcept {
  agent_ = agent;
  edge_ = 0;
  at_ = agent;
  time_s_ = Seconds{};
  row_ = 0;
  if (agent == world_.graph.agents()) {
    phase_ = Phase::kSum;
    return;
  }
  from_start_.begin(world_.sight.from_node(agent, agent));
}

int TourScorer::look_from_start(int rows) noexcept {
  int work = 1;
  while (!from_start_.done() && work <= rows) {
    const auto [swath, words, ends_swath] = from_start_.next(world_.sight, 1);
    const Cell first = world_.cells.at(8 * swath.first_byte, swath.first_row);
    const int taken = sightings_.taken();
    for_each_bit(words[0], [&](int bit) { (void)sightings_.see(first + bit, agent_, Seconds{}); });
    work += 1 + work::events_replayed(std::popcount(words[0]), sightings_.taken() - taken);
  }
  return work;
}

int TourScorer::sum(int rows) noexcept {
  const int count = std::min(rows / 3 + 1, world_.belief.mass_cell_count - row_);
  expected_.add(world_.belief, sightings_, row_, count);
  row_ += count;
  if (row_ == world_.belief.mass_cell_count) {
    finish();
    phase_ = Phase::kDone;
  }
  return 1 + work::cells_summed(count, world_.belief.has_sub_priors);
}

void TourScorer::finish() noexcept {
  Tour& tour = *tour_;
  tour.score = expected_.score(world_.belief, max_unseen_mass_);
  const Mass cost = !world_.belief.has_sub_priors ? expected_.expected_time()
                    : to_end_                     ? expected_.expected_sub_prior_time_to_end()
                                                  : expected_.expected_sub_prior_time(world_.belief);
  tour.cost = {cost, cost};
  tour.unseen = expected_.unseen();
  tour.complete = tour.score.complete;
  tour.scored = true;
  for (int m = 0; m < world_.graph.agents(); ++m) {
    EdgePath& path = tour.paths[index(m)];
    const Seconds end_s = expected_.path_end_s(m);
    Seconds time_s{};
    std::size_t kept = 0;
    while (kept < path.size() && time_s < end_s) {
      time_s += world_.seconds_along(m, path[kept++]);
    }
    path.resize(kept);
    tour.end_s[index(m)] = end_s;
  }
}

}  // namespace ivo::planner
