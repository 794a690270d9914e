// Which frames this robot's master may ever send, and which only while motion is permitted. What no rule allows is
// refused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "config/robot.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::firmware {

enum class FrameRefusal : std::uint8_t {
  kNone,
  kNotListed,           ///< no rule allows this COB-ID
  kWrongSize,           ///< not exactly the size that its rule states
  kNmtCommand,          ///< not a known NMT command, or to a node that is not ours
  kMotionBySdo,         ///< an SDO that writes a controlword or a target velocity other than 0
  kTargetTooHigh,       ///< beyond the wheel's largest speed
  kMotionNotPermitted,  ///< enables operation or carries a target, without a permit
};
inline constexpr int kFrameRefusals = 7;

[[nodiscard]] std::string_view name_of(FrameRefusal refusal) noexcept;

/// The allow-list (CiA 301, predefined connection set): NMT 000h, 2 bytes, to our drives or to all; SYNC 080h, 0 bytes;
/// our heartbeat 700h + master, 1 byte; SDO request 600h + drive, 8 bytes; RPDO1 200h + drive, 6 bytes {6040h, 60FFh}.
/// By SDO the controlword takes one expedited write only, of two bytes to 6040h:0 with value 0: disable voltage.
class FrameRules {
 public:
  /// Node-ids outside 1 to 127 are on no list.
  explicit FrameRules(const Robot& robot) noexcept;

  /// Cost: a few comparisons a drive.
  [[nodiscard]] FrameRefusal judge(const hal::CanFrame& frame, bool motion_permitted) const noexcept;

  /// The drive (by place in Robot::drives) that this frame can set in motion: an RPDO1 that enables operation or
  /// carries a target other than 0. Nothing for any other frame.
  [[nodiscard]] std::optional<std::size_t> drive_moved_by(const hal::CanFrame& frame) const noexcept;

 private:
  struct Drive {
    std::uint8_t node_id = 0;
    std::int64_t max_target = 0;
  };
  [[nodiscard]] std::optional<std::size_t> drive_at(std::uint16_t id, std::uint16_t base_id) const noexcept;
  [[nodiscard]] FrameRefusal judge_nmt(const hal::CanFrame& frame) const noexcept;
  [[nodiscard]] FrameRefusal judge_command(const hal::CanFrame& frame, const Drive& drive,
                                           bool motion_permitted) const noexcept;

  std::uint8_t master_node_id_;
  std::array<Drive, kWheels> drives_{};
};

}  // namespace ivo::firmware
