#include "planner/search/path_score.hpp"

#include <algorithm>
#include <cmath>

#include "planner/numeric/index.hpp"
#include "planner/search/work.hpp"
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
  own_mass_ = own_mass_steps_ = Mass{};
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
    begin_look(paths_[index(agent)].waypoints[0], Seconds{});
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
    using work::kCellsForgotten;
    const int count = std::min(rows, cells_->count() / kCellsForgotten + 1) * kCellsForgotten;
    const int cells = std::min(count, cells_->count() - cell_);
    sightings_.clear(cell_, cells);
    cell_ += cells;
    work += cells / kCellsForgotten;
    if (cell_ < cells_->count()) {
      return work;
    }
    phase_ = Phase::kLook;
    begin_agent(0);
  }
  while (phase_ == Phase::kLook && work <= rows) {
    const WaypointPath& path = paths_[index(agent_)];
    if (looking_) {
      work += look(rows - work + 1);
    } else if (leg_ + 1 >= path.waypoints.size()) {
      begin_agent(agent_ + 1);
      work += work::bytes(seen_.bytes());
    } else if (point_ > points_) {
      leg_begin_s_ += after_points(pace_, points_);  // of the last sight point to the last bit
      ++leg_;
      begin_leg();
    } else {
      begin_look(sight_point(path.waypoints[leg_], path.waypoints[leg_ + 1], point_, points_),
                 leg_begin_s_ + after_points(pace_, point_));
      ++point_;
    }
  }
  if (phase_ == Phase::kSum && work <= rows) {
    const int count = std::min((rows - work) / 3 + 1, belief_->mass_cell_count - cell_);
    expected_.add(*belief_, sightings_, cell_, count);
    cell_ += count;
    work += work::cells_summed(count, belief_->has_sub_priors);
    if (cell_ == belief_->mass_cell_count) {
      phase_ = Phase::kDone;
    }
  }
  return work;
}

void PathScorer::begin_look(Point from, Seconds time_s) noexcept {
  eye_ = from;
  eye_s_ = time_s;
  row_ = 0;
  looking_ = true;
}

// Only cells that this agent has not seen before: later looks at them change nothing.
int PathScorer::look(int rows) noexcept {
  const SightDisc disc(*cells_, eye_, paths_[index(agent_)].sight_radius_m);
  int work = 1;
  for (; disc.first_row() + row_ <= disc.last_row() && work <= rows; ++row_) {
    const int row = disc.first_row() + row_;
    const SightDisc::Run run = disc.run(row);
    int cells = 0;
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
        fresh = visible(fresh, row, byte, work);
      }
      cells += std::popcount(fresh);
      seen_.set_window(row, byte, known | fresh);
      const Cell first = cells_->at(8 * byte, row);
      for_each_bit(fresh, [&](int bit) { (void)sightings_.see(first + bit, agent_, eye_s_); });
      if (belief_->has_sub_priors) {
        take_own(first, fresh);
      }
    }
    work += work::disc_row(cells);
  }
  looking_ = disc.first_row() + row_ <= disc.last_row();
  return work;
}

void PathScorer::take_own(Cell first, std::uint64_t fresh) noexcept {
  const int steps = std::min(std::max(step_of(eye_s_), 1) - 1, belief_->sub_prior_steps);
  Mass mass{};
  for_each_bit(fresh, [&](int bit) { mass += belief_->sub_mass[index(agent_)][index(first + bit)]; });
  own_mass_ += mass;
  own_mass_steps_ += mass * steps;
}

PlanScore PathScorer::score() const noexcept {
  PlanScore score = expected_.score(*belief_, max_unseen_mass_);
  if (belief_->has_sub_priors) {
    const Mass left = std::max(Mass{}, belief_->sub_whole - own_mass_);
    score.expected_sub_prior_time_own_s =
        to_double(own_mass_steps_ + left * belief_->sub_prior_steps) / to_double(belief_->sub_whole) * kStepSeconds;
  }
  return score;
}

// Of a row's cells, those that nothing hides.
std::uint64_t PathScorer::visible(std::uint64_t word, int row, int byte, int& work) const noexcept {
  std::uint64_t hidden = 0;
  for_each_bit(word, [&](int bit) {
    const int column = 8 * byte + bit;
    int walked = 0;
    if (!line_of_sight(*cells_, eye_, cells_->at(column, row), walked)) {
      hidden |= std::uint64_t{1} << static_cast<unsigned>(bit);
    }
    work += work::ray(walked);
  });
  return word & ~hidden;
}

}  // namespace ivo::planner
