// What a drive is asked and told before it may run, in order, each step with the name that a failure is reported by.
#pragma once

#include <cstdint>

#include "config/base/contract.hpp"
#include "config/base/static_vector.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"

namespace ivo::drivers {

enum class StepAction : std::uint8_t {
  kWrite,        ///< value; where the drive refuses it and there is an alternative, that
  kVerify,       ///< read; under mask it is value, or the alternative where there is one
  kVerifyOneOf,  ///< read; of `value`, the bit whose number was read is set: one of several answers will do
  kVerifyRange,  ///< read; from value to highest
  kKeep,         ///< read for people to see: identity(), by sub-index
  kChooseMode,   ///< read 6502h; a velocity mode must be among them
  kWriteMode,    ///< the mode chosen
  kVerifyMode,   ///< read until it is the mode chosen, within rates::kStateChangeTimeout: some drives show it late
  kDisablePdo,   ///< read a PDO's COB-ID and, where it is valid, write it back invalid
  kSilencePdo,   ///< the same, unless it is the PDO that the drive's feedback comes by
};

/// Which PDO a step sets up. Where the drive refuses one, a PDO that is right as it is will do instead
/// (pdo_search.hpp).
enum class PdoRole : std::uint8_t { kNone, kCommand, kFeedback };

enum class StepMode : std::uint8_t { kAny, kProfileVelocity, kCyclicSynchronousVelocity };

struct StartupStep {
  const char* name = "";
  StepAction action = StepAction::kWrite;
  ObjectAddress object{};
  std::uint8_t bytes = 0;
  std::uint32_t value = 0;
  std::uint32_t alternative = 0;  ///< 0: none
  std::uint32_t highest = 0xFFFF'FFFF;
  std::uint32_t mask = 0xFFFF'FFFF;
  bool may_refuse = false;         ///< an abort is no failure: the step that reads it back judges what is in force
  bool may_be_missing = false;     ///< an abort that says that there is no such object is no failure
  StepMode mode = StepMode::kAny;  ///< left out in any other mode than this
  PdoRole role = PdoRole::kNone;
  const char* refused_name = "";  ///< of a role: the step's name when no other PDO would do either
};

using StartupSteps = StaticVector<StartupStep, 112>;

inline void add(StartupSteps& steps, const StartupStep& step) noexcept { IVO_CONTRACT(steps.push_back(step)); }

/// First the drive's identity, then target 0 and voltage off: a drive that a dead master left turning stops here,
/// whatever becomes of the rest. Then SYNC, who watches whom, what the drive does by itself when something fails, its
/// ramps; then the PDOs in the order of CiA 301: invalid, mapping emptied, filled, counted, read back, valid again; at
/// last the mode, and the target again, read back. All before the node goes Operational.
///
/// What is judged, and how: at each step in the source.
[[nodiscard]] StartupSteps startup_steps(const Robot& robot, Wheel wheel) noexcept;

}  // namespace ivo::drivers
