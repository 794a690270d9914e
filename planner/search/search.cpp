#include "planner/search/search.hpp"

#include <algorithm>
#include <cmath>

#include "planner/world/visibility.hpp"

namespace ivo::planner {
namespace {

// Of MMAS, before its best plan is improved; on a large graph with fewer ants, so that it does not take long.
constexpr int kFastGenerations = 5;
constexpr int kFastAntsNodes = 3000;
constexpr int kFastAntsLeast = 1;
// Where it cannot be improved, MMAS goes on, and begins anew after so many generations without a better plan.
constexpr int kRestartAfter = 60;

// Of a part at most: what parts multiply it by stays a whole number.
constexpr int kMostRowsAtOnce = 1 << 16;

}  // namespace

void Search::start(const ColonyParameters& parameters) noexcept {
  parameters_ = parameters;
  improving_ = false;
  last_slice_ = SliceKind::kNone;
  ColonyParameters colony = parameters;
  improvable_ = parameters.profile == Profile::kFast &&
                improver_.open({.max_unseen_mass = parameters.ant.max_unseen_mass, .seed = parameters.seed});
  if (improvable_) {
    colony.generations = std::min(kFastGenerations, parameters.generations);
    colony.ants =
        std::min(parameters.ants, std::max(kFastAntsLeast, kFastAntsNodes / std::max(1, world_.graph.nodes())));
  }
  if (parameters.profile == Profile::kFast) {
    colony.ant.completes = true;
    if (colony.heuristic == Heuristic::kTsp) {
      colony.heuristic = Heuristic::kUnseen;
    }
    colony.restart_after = kRestartAfter;
  }
  colony_.start(colony);
  ready_ = true;
}

void Search::step(Budget budget) noexcept {
  last_slice_ = kind();
  int left = budget.units;
  while (left > 0 && last_slice_ != SliceKind::kNone && kind() == last_slice_) {
    const int rows = std::min(left, kMostRowsAtOnce);
    if (improving_) {
      left -= improver_.advance(rows);
    } else if (!colony_.done()) {
      left -= colony_.advance(rows);
    } else {
      improver_.start(colony_.best());
      improving_ = true;
      --left;
    }
  }
  last_slice_was_full_ = left <= 0;
  last_slice_units_ = budget.units - left;
}

int Search::generation() const noexcept { return colony_.generation() + (improving_ ? improver_.generation() : 0); }

bool Search::done() const noexcept {
  return !ready_ || (colony_.done() && (!improves() || generation() >= parameters_.generations));
}

SliceKind Search::kind() const noexcept {
  if (done()) {
    return SliceKind::kNone;
  }
  if (!improving_) {
    switch (colony_.phase()) {
      case Colony::Phase::kAnt:
        return SliceKind::kAnts;
      case Colony::Phase::kScoreBest:
      case Colony::Phase::kScoreAnt:
        return SliceKind::kScore;
      case Colony::Phase::kRaise:
      case Colony::Phase::kEvaporate:
      case Colony::Phase::kClamp:
        return SliceKind::kTrails;
      case Colony::Phase::kDone:
        return SliceKind::kDrafts;
    }
  }
  switch (improver_.phase()) {
    case Improver::Phase::kRestore:
    case Improver::Phase::kJudgeFirst:
      return SliceKind::kDrafts;
    case Improver::Phase::kScore:
      return SliceKind::kPathScore;
    default:
      return SliceKind::kChanges;
  }
}

Progress Search::progress() const noexcept {
  Progress progress{.generation = generation(),
                    .generations = parameters_.generations,
                    .done = done(),
                    .has_plan = ready_ && colony_.has_best(),
                    .best = {}};
  if (progress.has_plan) {
    progress.best = improved() ? improver_.best_score() : colony_.best().score;
  }
  return progress;
}

void Search::best_plan(Plan& plan) const noexcept {
  IVO_CONTRACT(ready_ && colony_.has_best());
  const Graph& graph = world_.graph;
  const Tour& best = colony_.best();
  plan.score = improved() ? improver_.best_score() : best.score;
  plan.paths.resize(index(graph.agents()));
  for (int m = 0; m < graph.agents(); ++m) {
    AgentPath& path = plan.paths[index(m)];
    path.waypoints.clear();
    if (improved()) {
      for (const Place& place : improver_.best_waypoints(m)) {
        (void)path.waypoints.push_back(improver_.point_at(place));
      }
    } else {
      (void)path.waypoints.push_back(graph.position(m));
      for (const Edge e : best.paths[index(m)]) {
        (void)path.waypoints.push_back(graph.position(graph.head(e)));
      }
    }
    cut(path, improved() ? improver_.best_end_s(m) : to_double(best.end_s[index(m)]), world_.speeds_mps[index(m)]);
  }
}

// A path ends at the sight point that shows its last new cell.
void Search::cut(AgentPath& path, double end_s, double speed_mps) const noexcept {
  path.duration_s = end_s;
  path.length_m = end_s * speed_mps;
  double left_m = path.length_m;
  std::size_t kept = 1;
  for (; kept < path.waypoints.size() && left_m > 1e-6; ++kept) {
    const Point from = path.waypoints[kept - 1];
    Point& to = path.waypoints[kept];
    const double dx = to.x_m - from.x_m;
    const double dy = to.y_m - from.y_m;
    const double length_m = std::sqrt(dx * dx + dy * dy);
    if (left_m < length_m) {
      const int points = sight_points(length_m, world_.cells.cell_m());
      const int last = static_cast<int>(left_m / length_m * points + 0.5);
      to = sight_point(from, to, std::min(last, points), points);
    }
    left_m -= length_m;
  }
  path.waypoints.resize(kept);
}

void Search::learn_from(const Search& other) noexcept {
  if (other.improving_ && improving_) {
    improver_.learn_from(other.improver_);
  } else if (!other.improving_ && !improving_ && other.colony_.has_best()) {
    colony_.offer(other.colony_.best());
  }
}

}  // namespace ivo::planner
