// The search itself: where everybody is, how far they have come, and whether it is over (paper, "Real-life
// Experiments").
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "config/mission.hpp"
#include "firmware/mission/search_object.hpp"
#include "firmware/mission/simulated_person.hpp"
#include "planner/search/plan.hpp"

namespace ivo::firmware {

enum class SearchState : std::uint8_t { kRunning, kFound, kPathsEnded };

/// What the run needs to know of an agent, without strings: part of the loop.
struct Searcher {
  AgentKind kind = AgentKind::kRobot;
  PersonMotion motion = PersonMotion::kSimulated;
  Point start;
  double speed_mps = 0.5;
  double sight_radius_m = 2.5;
};
using Searchers = StaticVector<Searcher, limits::kAgents>;

struct AgentTrack {
  Point position;
  double moved_m = 0.0;   ///< since the search started
  double before_m = 0.0;  ///< of it, before the plan that is followed now
  Duration under_way{};   ///< until the path ended
  bool path_ended = false;
};

/// How far a search has come.
struct SearchProgress {
  std::array<AgentTrack, limits::kAgents> tracks{};
  Duration elapsed{};
  SearchState state = SearchState::kRunning;
  std::optional<int> finder;
};

class SearchRun {
 public:
  SearchRun(const planner::Cells& cells, const Searchers& searchers) noexcept;

  /// Everybody is at their start; `plan` outlives the search.
  void start(Instant now, const planner::Plan& plan, const SearchObject& object) noexcept;

  /// Everybody is where `left` says; time stands until go_on(). `plan` as in start().
  void resume(const planner::Plan& plan, const SearchObject& object, const SearchProgress& left) noexcept;
  void go_on(Instant now) noexcept;

  /// Under way: `plan` is followed from here on, by everybody from where they are; it outlives the search.
  void follow(const planner::Plan& plan) noexcept;
  /// The same map, as another planner has it.
  void look_through(const planner::Cells& cells) noexcept { cells_ = &cells; }

  /// A person whose place comes from outside is at `place`; of others nothing is heeded.
  void report(int agent, Point place, Instant now) noexcept;
  /// Somebody says so; heeded, and true, while the search goes on.
  bool found_by(int agent) noexcept;

  /// One cycle: the robot is at `robot` and has or has not come to the end of its path; simulated persons walk on.
  /// Cost: a line of sight an agent.
  /// `plan_stands`: the paths may end the search.
  void update(Instant now, Point robot, bool robot_path_ended, bool plan_stands = true) noexcept;

  [[nodiscard]] SearchState state() const noexcept { return state_; }
  /// The lowest-numbered agent that found it.
  [[nodiscard]] std::optional<int> finder() const noexcept { return finder_; }
  /// Real search time so far: from the start to the find, or to the last update.
  [[nodiscard]] Duration elapsed() const noexcept { return elapsed_; }
  [[nodiscard]] const AgentTrack& track(int agent) const noexcept { return tracks_[static_cast<std::size_t>(agent)]; }
  /// It is known where that agent is.
  [[nodiscard]] bool present(int agent) const noexcept { return present(static_cast<std::size_t>(agent)); }
  /// None: never reported.
  [[nodiscard]] std::optional<Duration> report_age(int agent, Instant now) const noexcept;
  [[nodiscard]] int agents() const noexcept { return static_cast<int>(searchers_.size()); }

 private:
  [[nodiscard]] bool present(std::size_t agent) const noexcept;
  [[nodiscard]] bool at_the_end(std::size_t agent) const noexcept;

  const planner::Cells* cells_;
  const planner::Plan* plan_ = nullptr;
  Searchers searchers_;
  SearchObject object_;
  Instant started_{};
  Instant updated_{};
  Duration elapsed_{};
  SearchState state_ = SearchState::kRunning;
  std::optional<int> finder_;
  std::array<AgentTrack, limits::kAgents> tracks_{};
  std::array<SimulatedPerson, limits::kAgents> persons_{};
  std::array<std::optional<Instant>, limits::kAgents> reported_at_{};
};

}  // namespace ivo::firmware
