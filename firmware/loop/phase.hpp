// The ten steps of a cycle, in order: what ControlLoop::cycle calls, and what is measured of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ivo::firmware {

enum class Phase : std::uint8_t {
  kJudgeTime,       ///< how late this cycle is
  kTakeCommands,    ///< of the operator
  kDrainBus,        ///< every frame since the last cycle
  kLookAtDrives,    ///< stop inputs, states, odometry, wheel monitor
  kLookForObject,   ///< has somebody seen it
  kDecideMode,      ///< one table
  kChooseVelocity,  ///< follow, clamp, pass the gate
  kWrite,           ///< SYNC and targets, through the guarded bus
  kThink,           ///< slices of the planner
  kPublish,         ///< status for the rest of the program
};
inline constexpr std::size_t kPhases = 10;

[[nodiscard]] constexpr std::string_view name_of(Phase phase) noexcept {
  switch (phase) {
    case Phase::kJudgeTime:
      return "judge time";
    case Phase::kTakeCommands:
      return "take commands";
    case Phase::kDrainBus:
      return "drain bus";
    case Phase::kLookAtDrives:
      return "look at drives";
    case Phase::kLookForObject:
      return "look for object";
    case Phase::kDecideMode:
      return "decide mode";
    case Phase::kChooseVelocity:
      return "choose velocity";
    case Phase::kWrite:
      return "write";
    case Phase::kThink:
      return "think";
    case Phase::kPublish:
      return "publish";
  }
  return "";
}

}  // namespace ivo::firmware
