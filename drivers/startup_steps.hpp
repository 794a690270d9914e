// What a drive is asked and told before it may run, in order, each step with the name that a failure is reported by.
#pragma once

#include <cstdint>

#include "config/base/static_vector.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"

namespace ivo::drivers {

enum class StepAction : std::uint8_t {
  kWrite,        ///< value
  kVerify,       ///< read; value under mask is as expected
  kVerifyOneOf,  ///< read; of `value`, the bit whose number was read is set: one of several answers will do
  kChooseMode,   ///< read 6502h; a velocity mode must be among them
  kWriteMode,    ///< the mode chosen
  kVerifyMode,   ///< read until it is the mode chosen, within rates::kStateChangeTimeout: some drives show it late
};

struct StartupStep {
  const char* name = "";
  StepAction action = StepAction::kWrite;
  ObjectAddress object;
  std::uint8_t bytes = 0;
  std::uint32_t value = 0;
  std::uint32_t mask = 0xFFFF'FFFF;
  bool may_refuse = false;  ///< an abort is no failure: the step that reads it back judges what is in force
};

using StartupSteps = StaticVector<StartupStep, 40>;

/// First the drive's identity, then target 0 and voltage off: a drive that a dead master left turning stops here,
/// whatever becomes of the rest. Then CiA 301 order: PDO invalid, mapping emptied, filled, counted, valid again; then
/// mode, ready to start. Written before the node goes Operational.
[[nodiscard]] StartupSteps startup_steps(const DriveParameters& drive, std::uint8_t master_node_id) noexcept;

}  // namespace ivo::drivers
