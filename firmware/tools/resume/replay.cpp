#include "firmware/tools/resume/replay.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/motion/path_progress.hpp"

namespace ivo::firmware {
namespace {

class Replay {
 public:
  Replay(const Searchers& searchers, const Pose& start, KeptSearch& kept)
      : searchers_(searchers), search_(kept.search), at_s_(kept.at_s), start_(start) {
    if (search_.started) {
      take_up_path();
    }
  }

  void take(const LoggedStep& step) {
    if (step.t_s < at_s_) {
      return;  // it is in what was kept
    }
    switch (step.kind) {
      case LoggedStep::Kind::kSetOff:
        set_off(step);
        break;
      case LoggedStep::Kind::kPosition:
        move(step);
        break;
      case LoggedStep::Kind::kFound:
        pass_time(step.t_s);
        search_.progress.finder = static_cast<int>(step.agent);
        search_.progress.state = SearchState::kFound;
        break;
      case LoggedStep::Kind::kPathsEnded:
        pass_time(step.t_s);
        search_.progress.state = SearchState::kPathsEnded;
        break;
    }
  }

  // When the search was last known to go on.
  [[nodiscard]] double at_s() const { return at_s_; }

 private:
  // For the first time, or after it was taken up: what lay between does not count.
  void set_off(const LoggedStep& step) {
    at_s_ = step.t_s;
    if (search_.started) {
      return;
    }
    search_.started = true;
    search_.progress = {};
    for (std::size_t m = 0; m < searchers_.size(); ++m) {
      search_.progress.tracks[m].position = searchers_[m].start;
    }
    search_.robot = start_;
    search_.distance_left_m = search_.plan.paths[0].length_m;
    take_up_path();
  }

  void take_up_path() {
    followed_ = path_.resume(search_.plan.paths[0].waypoints.span(), search_.robot.point(), search_.distance_left_m);
  }

  void pass_time(double t_s) {
    if (t_s > at_s_) {
      search_.progress.elapsed += from_seconds(t_s - at_s_);
      at_s_ = t_s;
    }
  }

  // The positions of all agents at one time are lines of their own.
  void move(const LoggedStep& step) {
    if (!search_.started || step.agent >= searchers_.size()) {
      return;
    }
    pass_time(step.t_s);
    AgentTrack& track = search_.progress.tracks[step.agent];
    const Point before = track.position;
    const Searcher& searcher = searchers_[step.agent];
    if (!track.path_ended) {
      const Duration step_time = search_.progress.elapsed - track.under_way;
      track.under_way = search_.progress.elapsed;
      // A simulated person goes at one speed and cuts no corner between two lines.
      track.moved_m += searcher.kind == AgentKind::kPerson && searcher.motion == PersonMotion::kSimulated
                           ? searcher.speed_mps * seconds(step_time)
                           : std::hypot(step.at.x_m - before.x_m, step.at.y_m - before.y_m);
    }
    track.position = step.at;
    if (searcher.kind == AgentKind::kRobot) {
      search_.robot = {step.at.x_m, step.at.y_m, search_.robot.heading_rad};
      if (followed_) {
        path_.update(step.at);
        search_.distance_left_m = path_.distance_left_m();
      }
    }
  }

  const Searchers& searchers_;
  ResumedSearch& search_;
  double at_s_;
  Pose start_;
  PathProgress path_;
  bool followed_ = false;
};

}  // namespace

void replay(const LoggedRun& log, const Searchers& searchers, const Pose& start, KeptSearch& kept) {
  Replay replay(searchers, start, kept);
  for (const LoggedStep& step : log.steps) {
    replay.take(step);
  }
  for (std::size_t m = 0; m < kept.search.plan.paths.size(); ++m) {
    AgentTrack& track = kept.search.progress.tracks[m];
    const bool simulated = searchers[m].kind == AgentKind::kPerson && searchers[m].motion == PersonMotion::kSimulated;
    track.moved_m =
        simulated ? std::min(track.moved_m, track.before_m + kept.search.plan.paths[m].length_m) : track.moved_m;
  }
  kept.at_s = replay.at_s();
  kept.consented = kept.consented || kept.search.started;
}

}  // namespace ivo::firmware
