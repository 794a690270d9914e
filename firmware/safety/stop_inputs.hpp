// Emergency stop and bumpers: what is pressed, or not heard of, stops the robot.
#pragma once

#include <cstdint>
#include <optional>

#include "config/robot.hpp"
#include "drivers/drive_fault.hpp"
#include "hal/api/digital_io.hpp"

namespace ivo::firmware {

/// Remembers nothing: the fault that it gives is latched where all faults are, and a released input says nothing at
/// all, so it restarts nothing.
class StopInputs {
 public:
  explicit StopInputs(const InputParameters& inputs) noexcept;

  /// Whether any input is fitted; without one every verdict is nothing.
  [[nodiscard]] bool fitted() const noexcept { return fitted_ != 0; }

  /// Each cycle: kStopInput while an input is pressed, code 0 for the emergency stop, else the lowest bumper's number,
  /// from 1; kStopInputsSilent when none is known to be pressed but the reading is older than rates::kInputsAge, or
  /// there was none yet.
  [[nodiscard]] std::optional<drivers::DriveFault> judge(const hal::DigitalSnapshot& snapshot) const noexcept;

 private:
  std::uint8_t fitted_ = 0;
};

}  // namespace ivo::firmware
