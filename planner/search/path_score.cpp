#include "planner/search/path_score.hpp"

#include <algorithm>
#include <cmath>

#include "planner/numeric/index.hpp"
#include "planner/world/sight_disc.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::planner {
namespace {

double distance_m(Point a, Point b) noexcept {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

double length_m(std::span<const Point> waypoints) noexcept {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    sum_m += distance_m(waypoints[i - 1], waypoints[i]);
  }
  return sum_m;
}

PlanScore PathScorer::score(const Cells& cells, const Belief& belief, std::span<const WaypointPath> paths,
                            double max_unseen_mass) noexcept {
  start(cells, belief, paths, max_unseen_mass);
  while (!done()) {
    (void)advance(1 << 20);
  }
  return score();
}

void PathScorer::start(const Cells& cells, const Belief& belief, std::span<const WaypointPath> paths,
                       double max_unseen_mass) noexcept {
  cells_ = &cells;
  belief_ = &belief;
  paths_.clear();
  for (const WaypointPath& path : paths) {
    (void)paths_.push_back(path);
  }
  max_unseen_mass_ = max_unseen_mass;
  expected_.clear();
  cell_ = 0;
  phase_ = Phase::kClear;
}

void PathScorer::begin_agent(int agent) noexcept {
  agent_ = agent;
  leg_ = 0;
  leg_begin_s_ = Seconds{};
  if (agent == static_cast<int>(paths_.size())) {
    cell_ = 0;
    phase_ = Phase::kSum;
    return;
  }
  seen_.open(cells_->columns(), cells_->rows());
  if (!paths_[index(agent)].waypoints.empty()) {
    (void)look(paths_[index(agent)].waypoints[0], Seconds{});
  }
  begin_leg();
}

void PathScorer::begin_leg() noexcept {
  const WaypointPath& path = paths_[index(agent_)];
  point_ = 1;
  points_ = 0;
  if (leg_ + 1 < path.waypoints.size()) {
    const double length = distance_m(path.waypoints[leg_], path.waypoints[leg_ + 1]);
    points_ = sight_points(length, cells_->cell_m());
    pace_ = Pace(length / (points_ * path.speed_mps));
  }
}

int PathScorer::advance(int rows) noexcept {
  int work = 1;
  if (phase_ == Phase::kClear) {
    constexpr int kCellsARow = 16;  // so many cost no more than a row of a disc
    const int count = std::min(rows, cells_->count() / kCellsARow + 1) * kCellsARow;
    const int cells = std::min(count, cells_->count() - cell_);
    sightings_.clear(cell_, cells);
    cell_ += cells;
    work += cells / kCellsARow;
    if (cell_ < cells_->count()) {
      return work;
    }
    phase_ = Phase::kLook;
    begin_agent(0);
  }
  while (phase_ == Phase::kLook && work <= rows) {
    const WaypointPath& path = paths_[index(agent_)];
    if (leg_ + 1 >= path.waypoints.size()) {
      begin_agent(agent_ + 1);
      work += 32;
    } else if (point_ > points_) {
      leg_begin_s_ += after_points(pace_, points_);  // of the last sight point to the last bit
      ++leg_;
      begin_leg();
    } else {
      work += look(sight_point(path.waypoints[leg_], path.waypoints[leg_ + 1], point_, points_),
                   leg_begin_s_ + after_points(pace_, point_));
      ++point_;
    }
  }
  if (phase_ == Phase::kSum && work <= rows) {
    const int count = std::min(rows - work + 1, belief_->mass_cell_count - cell_);
    expected_.add(*belief_, sightings_, cell_, count);
    cell_ += count;
    work += count;
    if (cell_ == belief_->mass_cell_count) {
      phase_ = Phase::kDone;
    }
  }
  return work;
}

// Only cells that this agent has not seen before: later looks at them change nothing.
int PathScorer::look(Point from, Seconds time_s) noexcept {
  const SightDisc disc(*cells_, from, paths_[index(agent_)].sight_radius_m);
  for (int row = disc.first_row(); row <= disc.last_row(); ++row) {
    const SightDisc::Run run = disc.run(row);
    for (int byte = run.first / 8; run.first <= run.last && byte * 8 <= run.last; byte += 8) {
      const int low = std::max(0, run.first - 8 * byte);
      const int high = std::min(63, run.last - 8 * byte);
      const std::uint64_t inside = (~std::uint64_t{0} >> static_cast<unsigned>(63 - (high - low)))
                                   << static_cast<unsigned>(low);
      const std::uint64_t known = seen_.window(row, byte);
      std::uint64_t fresh = inside & ~known;
      if (fresh == 0) {
        continue;
      }
      if (!disc.open()) {
        std::uint64_t hidden = 0;
        for_each_bit(fresh, [&](int bit) {
          if (!line_of_sight(*cells_, from, cells_->at(8 * byte + bit, row))) {
            hidden |= std::uint64_t{1} << static_cast<unsigned>(bit);
          }
        });
        fresh &= ~hidden;
      }
      seen_.set_window(row, byte, known | fresh);
      const Cell first = cells_->at(8 * byte, row);
      for_each_bit(fresh, [&](int bit) { (void)sightings_.see(first + bit, agent_, time_s); });
    }
  }
  return disc.last_row() - disc.first_row() + 1;
}

}  // namespace ivo::planner
