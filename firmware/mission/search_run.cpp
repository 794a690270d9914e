#include "firmware/mission/search_run.hpp"

#include <cmath>

namespace ivo::firmware {
namespace {

constexpr double kArrived_m = 1.0;  // a tap on a map is no nearer

}  // namespace

SearchRun::SearchRun(const planner::Cells& cells, const Searchers& searchers) noexcept
    : cells_(&cells), searchers_(searchers) {
  for (std::size_t m = 0; m < searchers_.size(); ++m) {
    tracks_[m].position = searchers_[m].start;
  }
}

void SearchRun::start(Instant now, const planner::Plan& plan, const SearchObject& object) noexcept {
  object_ = object;
  plan_ = &plan;
  started_ = now;
  updated_ = now;
  elapsed_ = Duration::zero();
  state_ = SearchState::kRunning;
  finder_.reset();
  for (std::size_t m = 0; m < searchers_.size(); ++m) {
    tracks_[m] = {.position = reported_at_[m] ? tracks_[m].position : searchers_[m].start};
    persons_[m].start(plan.paths[m], searchers_[m].speed_mps);
  }
}

void SearchRun::resume(const planner::Plan& plan, const SearchObject& object, const SearchProgress& left) noexcept {
  object_ = object;
  plan_ = &plan;
  elapsed_ = left.elapsed;
  state_ = left.state;
  finder_ = left.finder;
  tracks_ = left.tracks;
  for (std::size_t m = 0; m < searchers_.size(); ++m) {
    persons_[m].resume(plan.paths[m], searchers_[m].speed_mps, tracks_[m].moved_m - tracks_[m].before_m);
  }
}

void SearchRun::go_on(Instant now) noexcept {
  started_ = now - elapsed_;
  updated_ = now;
}

void SearchRun::follow(const planner::Plan& plan) noexcept {
  plan_ = &plan;
  for (std::size_t m = 0; m < searchers_.size(); ++m) {
    tracks_[m].before_m = tracks_[m].moved_m;
    tracks_[m].path_ended = false;
    persons_[m].follow(plan.paths[m]);
  }
}

void SearchRun::report(int agent, Point place, Instant now) noexcept {
  const auto m = static_cast<std::size_t>(agent);
  if (m >= searchers_.size() || searchers_[m].motion != PersonMotion::kReported ||
      searchers_[m].kind != AgentKind::kPerson) {
    return;
  }
  AgentTrack& track = tracks_[m];
  if (reported_at_[m] && plan_ != nullptr && state_ == SearchState::kRunning) {
    track.moved_m += std::hypot(place.x_m - track.position.x_m, place.y_m - track.position.y_m);
  }
  track.position = place;
  reported_at_[m] = now;
}

bool SearchRun::found_by(int agent) noexcept {
  if (plan_ == nullptr || state_ != SearchState::kRunning || agent < 0 || agent >= agents()) {
    return false;
  }
  finder_ = agent;
  state_ = SearchState::kFound;
  return true;
}

std::optional<Duration> SearchRun::report_age(int agent, Instant now) const noexcept {
  const std::optional<Instant>& at = reported_at_[static_cast<std::size_t>(agent)];
  return at ? std::optional(now - *at) : std::nullopt;
}

// Somewhere, and known to be there.
bool SearchRun::present(std::size_t agent) const noexcept {
  return searchers_[agent].kind == AgentKind::kRobot || searchers_[agent].motion == PersonMotion::kSimulated ||
         reported_at_[agent].has_value();
}

// Of a person who is reported. One who is not may stop anywhere: the paths of the others decide. A path may pass near
// its own end: half of it must lie behind.
bool SearchRun::at_the_end(std::size_t agent) const noexcept {
  if (!reported_at_[agent]) {
    return true;
  }
  const planner::AgentPath& path = plan_->paths[agent];
  const AgentTrack& track = tracks_[agent];
  const Point end = path.waypoints.back();
  return std::hypot(end.x_m - track.position.x_m, end.y_m - track.position.y_m) <= kArrived_m &&
         track.moved_m - track.before_m >= 0.5 * path.length_m;
}

void SearchRun::update(Instant now, Point robot, bool robot_path_ended, bool plan_stands) noexcept {
  if (state_ != SearchState::kRunning) {
    return;
  }
  const Duration dt = now - updated_;
  updated_ = now;
  elapsed_ = now - started_;
  bool all_ended = true;
  for (std::size_t m = 0; m < searchers_.size(); ++m) {
    const Searcher& searcher = searchers_[m];
    const Duration under_way = tracks_[m].path_ended ? tracks_[m].under_way : elapsed_;
    if (searcher.kind == AgentKind::kRobot) {
      tracks_[m].moved_m += std::hypot(robot.x_m - tracks_[m].position.x_m, robot.y_m - tracks_[m].position.y_m);
      tracks_[m].position = robot;
      tracks_[m].under_way = under_way;
      tracks_[m].path_ended = robot_path_ended;
    } else if (searcher.motion == PersonMotion::kSimulated) {
      persons_[m].walk(dt);
      tracks_[m] = {persons_[m].position(), tracks_[m].before_m + persons_[m].walked_m(), tracks_[m].before_m,
                    under_way, persons_[m].arrived()};
    } else {
      tracks_[m].under_way = under_way;
      tracks_[m].path_ended = at_the_end(m);
    }
    all_ended = all_ended && tracks_[m].path_ended;
    if (present(m) && !finder_ && object_.found_from(*cells_, tracks_[m].position, searcher.sight_radius_m)) {
      finder_ = static_cast<int>(m);
    }
  }
  if (finder_) {
    state_ = SearchState::kFound;
  } else if (all_ended && plan_stands) {
    state_ = SearchState::kPathsEnded;
  }
}

}  // namespace ivo::firmware
