// What the loop shows to the rest of the program: the newest state, whole, once a cycle.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "drivers/drive_group.hpp"
#include "firmware/loop/overrun_policy.hpp"
#include "firmware/mission/search_run.hpp"
#include "firmware/safety/mode.hpp"
#include "hal/api/can_bus.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware {

/// Why nobody goes on searching, when it was not the search that ended.
enum class StopCause : std::uint8_t { kNone, kAsked, kNoConsent, kPlanNotKept };

/// Why the robot stands though the search goes on, when it is not for a fault.
enum class PauseCause : std::uint8_t { kNone, kAsked, kBeatLost, kReplan, kNoGo };

struct LoopCounters {
  std::uint64_t cycles = 0;
  std::uint64_t skipped = 0;           ///< periods without a cycle
  std::uint64_t refused_commands = 0;  ///< by the command gate
  std::uint64_t malformed_frames = 0;  ///< of drives, with a wrong length
  std::uint64_t refused_frames = 0;    ///< by the guarded bus
  hal::BusCounters bus;
  hal::BusState bus_state = hal::BusState::kActive;
};

struct LoopStatus {
  Instant at{};
  Mode mode = Mode::kPlanning;
  bool plan_ready = false;
  std::uint32_t plan_number = 1;  ///< of the plan that `planning` is about
  bool preparing = false;         ///< a plan is to be made anew, and its tables are not there yet
  bool power_off = false;         ///< the drives have said that they are off
  bool finished = false;          ///< drives off or given up: no cycle is needed any more
  planner::Progress planning;
  Pose robot;
  std::array<AgentTrack, limits::kAgents> tracks{};
  SearchState search = SearchState::kRunning;
  bool search_started = false;   ///< by this run, or by the one that it takes up
  bool consented = false;        ///< somebody has agreed in this run
  double distance_left_m = 0.0;  ///< of the robot's path, once it follows it
  /// The plan that distance_left_m and the tracks' before_m are about; 0: none yet.
  std::uint32_t way_of_plan = 0;
  bool way_followed = false;  ///< it is the one followed, not one that waits for consent
  std::optional<int> finder;
  Duration search_time{};
  StopCause stop_cause = StopCause::kNone;
  std::uint32_t pauses = 0;                    ///< how often a pause was asked for, in motion or not
  PauseCause pause_cause = PauseCause::kNone;  ///< of the last that ended motion
  bool watched = false;                        ///< the last consent counts only while beats come
  std::optional<Duration> beat_age{};          ///< since the last beat; none: there was none
  std::array<std::optional<Duration>, limits::kAgents> report_age{};  ///< since each agent's last report
  drivers::GroupState drives = drivers::GroupState::kBooting;
  drivers::DriveFault drive_fault;
  drivers::DriveFault stop_held;  ///< a stop input that is pressed now: the robot does not get ready
  std::uint32_t times_ready = 0;  ///< how often it has begun to await consent: an answer is to the last of them
  Lateness lateness = Lateness::kInTime;
  LoopCounters counters;
};

/// What the rest of the program may say; stop and pause are asked for by ControlLoop::request_stop and request_pause.
struct OperatorCommand {
  enum Kind : std::uint8_t {
    kConsent,
    kNoConsent,
    kPlanNotKept,
    kClearFault,  ///< in Mode::kFault: start the drives up again; motion needs consent anew
    kPlanAnew,    ///< the plan is void, a robot that moves pauses; one of the next two follows
    kPlanWith,    ///< `planner`, which is prepared
    kPlanAsBefore,
    kEnough,  ///< the best plan so far is the plan
    kFound,   ///< by `agent`
    kReport,  ///< the person `agent` is at `place`
  };

  // NOLINTNEXTLINE(google-explicit-constructor): most commands are a word
  constexpr OperatorCommand(Kind what = kConsent) noexcept : kind(what) {}

  Kind kind;
  std::uint8_t agent = 0;
  bool watched = false;  ///< of a consent: it counts only while beats come
  /// Of a consent: LoopStatus::pauses and times_ready when it was given; it is void after another pause, and when the
  /// robot was not ready in between. times_ready 0: to whichever is now.
  std::uint32_t pauses = 0;
  std::uint32_t times_ready = 0;
  Point place;
  planner::Planner* planner = nullptr;  ///< outlives the loop
};

}  // namespace ivo::firmware
