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
  bool power_off = false;  ///< the drives have said that they are off
  bool finished = false;   ///< drives off or given up: no cycle is needed any more
  planner::Progress planning;
  Pose robot;
  std::array<AgentTrack, limits::kAgents> tracks{};
  SearchState search = SearchState::kRunning;
  bool search_started = false;   ///< by this run, or by the one that it takes up
  bool consented = false;        ///< somebody has agreed in this run
  double distance_left_m = 0.0;  ///< of the robot's path, once it follows it
  std::optional<int> finder;
  Duration search_time{};
  StopCause stop_cause = StopCause::kNone;
  drivers::GroupState drives = drivers::GroupState::kBooting;
  drivers::DriveFault drive_fault;
  drivers::DriveFault stop_held;  ///< a stop input that is pressed now: the robot does not get ready
  std::uint32_t times_ready = 0;  ///< how often it has begun to await consent: an answer is to the last of them
  Lateness lateness = Lateness::kInTime;
  LoopCounters counters;
};

/// What the rest of the program may say; stop is asked for by ControlLoop::request_stop.
enum class OperatorCommand : std::uint8_t {
  kConsent,
  kNoConsent,
  kPlanNotKept,
  kClearFault,  ///< in Mode::kFault: start the drives up again; motion needs consent anew
};

}  // namespace ivo::firmware
