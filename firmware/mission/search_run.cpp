#include "firmware/mission/search_run.hpp"

#include <cmath>

namespace ivo::firmware {

SearchRun::SearchRun(const planner::Cells& cells, const Searchers& searchers) noexcept
    : cells_(cells), searchers_(searchers) {
  for (std::size_t m = 0; m < searchers_.size(); ++m) {
    tracks_[m].position = searchers_[m].start;
  }
}

void SearchRun::start(Instant now, const planner::Plan& plan, const SearchObject& object) noexcept {
  object_ = object;
  started_ = now;
  updated_ = now;
  elapsed_ = Duration::zero();
  state_ = SearchState::kRunning;
  finder_.reset();
  for (std::size_t m = 0; m < searchers_.size(); ++m) {
    tracks_[m] = {.position = searchers_[m].start};
    persons_[m].start(plan.paths[m], searchers_[m].speed_mps);
  }
}

void SearchRun::resume(const planner::Plan& plan, const SearchObject& object, const SearchProgress& left) noexcept {
  object_ = object;
  elapsed_ = left.elapsed;
  state_ = left.state;
  finder_ = left.finder;
  tracks_ = left.tracks;
  for (std::size_t m = 0; m < searchers_.size(); ++m) {
    persons_[m].resume(plan.paths[m], searchers_[m].speed_mps, tracks_[m].moved_m);
  }
}

void SearchRun::go_on(Instant now) noexcept {
  started_ = now - elapsed_;
  updated_ = now;
}

void SearchRun::update(Instant now, Point robot, bool robot_path_ended) noexcept {
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
      tracks_[m] = {persons_[m].position(), persons_[m].walked_m(), under_way, persons_[m].arrived()};
    } else {
      tracks_[m].path_ended = true;  // a reported person may stop anywhere: the paths of the others decide
    }
    all_ended = all_ended && tracks_[m].path_ended;
    const bool present = searcher.kind == AgentKind::kRobot || searcher.motion == PersonMotion::kSimulated;
    if (present && !finder_ && object_.found_from(cells_, tracks_[m].position, searcher.sight_radius_m)) {
      finder_ = static_cast<int>(m);
    }
  }
  if (finder_) {
    state_ = SearchState::kFound;
  } else if (all_ended) {
    state_ = SearchState::kPathsEnded;
  }
}

}  // namespace ivo::firmware
