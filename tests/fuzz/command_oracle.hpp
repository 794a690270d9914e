// What a frame would make a wheel do, read from the standard and the robot alone: no line of it is the product's.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "config/robot.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::fuzz {

struct Commanded {
  std::size_t drive = 0;  ///< by place in Robot::drives
  bool enables = false;   ///< the controlword asks for Operation Enabled: bits 0 to 3 set, bit 7 clear
  double radps = 0.0;     ///< asked of the wheel
};

inline std::int32_t signed_32_at(const hal::CanFrame& frame, std::size_t byte) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= static_cast<std::uint32_t>(frame.data[byte + i]) << (8 * i);
  }
  return static_cast<std::int32_t>(value);
}

inline bool enables(const hal::CanFrame& frame) { return (frame.data[0] & 0x8F) == 0x0F; }

/// What `frame` commands drive `drive`, if it is one of that drive's RPDOs.
inline std::optional<Commanded> commanded(const Robot& robot, std::size_t drive, const hal::CanFrame& frame) {
  const DriveParameters& parameters = robot.drives[drive];
  const double unit_radps = 1.0 / (parameters.gear_ratio * parameters.velocity_per_radps);
  if (frame.id == 0x200 + parameters.node_id) {
    const bool own = robot.pdo_layout == PdoLayout::kOwn;
    return Commanded{drive, enables(frame), own ? signed_32_at(frame, 2) * unit_radps : 0.0};
  }
  const std::size_t first = drive / 2 * 2;
  if (robot.pdo_layout == PdoLayout::kShared && frame.id == 0x300 + robot.drives[first].node_id) {
    return Commanded{drive, false, signed_32_at(frame, drive == first ? 0 : 4) * unit_radps};
  }
  return std::nullopt;
}

/// Whether it can set the wheel in motion.
inline bool moves(const Commanded& command) { return command.enables || command.radps != 0.0; }

/// Within the wheel's largest speed, but for the rounding to a whole unit of the drive.
inline bool in_range(const Robot& robot, const Commanded& command) {
  const DriveParameters& parameters = robot.drives[command.drive];
  return std::abs(command.radps) <=
         robot.base.max_wheel_radps + 1.0 / (parameters.gear_ratio * parameters.velocity_per_radps);
}

}  // namespace ivo::fuzz
