// Which frames this robot's master may ever send, and which only while motion is permitted. What no rule allows is
// refused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
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
  kSdoInMotion,         ///< an SDO while motion is permitted: the bus and the drives have other work then
  kNotWithTheOthers,    ///< could move a wheel, and another that should move with it was refused
};
inline constexpr int kFrameRefusals = 9;

[[nodiscard]] std::string_view name_of(FrameRefusal refusal) noexcept;

/// The ways on which frames move drives, a bit each: 0 to 3 a drive's own RPDO, by place in Robot::drives; 4 to 7 its
/// target in an RPDO that it shares.
using MotionWays = std::uint8_t;
inline constexpr MotionWays kAllWays = 0xFF;

/// The allow-list (CiA 301, predefined connection set): NMT 000h, 2 bytes, to our drives or to all; SYNC 080h, 0 bytes;
/// our heartbeat 700h + master, 1 byte; SDO request 600h + drive, 8 bytes, while motion is not permitted. Commands in
/// layout kOwn: RPDO1 to RPDO4 (200h, 300h, 400h, 500h + drive), 6 bytes {6040h, 60FFh}. In kShared: RPDO1 200h +
/// drive, 2 bytes {6040h}, and 300h + the first drive of each pair, 8 bytes {60FFh of the first, 60FFh of the second}.
/// By SDO the controlword takes one expedited write only, of two bytes to 6040h:0 with value 0: disable voltage.
class FrameRules {
 public:
  /// Node-ids outside 1 to 127 are on no list.
  explicit FrameRules(const Robot& robot) noexcept;

  /// `motion_permitted`: for a frame that moves drives, on all of its ways; for any other, at all in this cycle. Cost:
  /// a few comparisons a drive.
  [[nodiscard]] FrameRefusal judge(const hal::CanFrame& frame, bool motion_permitted) const noexcept;

  /// On which ways this frame can set drives in motion: it enables operation or carries a target other than 0. None for
  /// any other frame.
  [[nodiscard]] MotionWays moved_by(const hal::CanFrame& frame) const noexcept;

 private:
  struct Drive {
    std::uint8_t node_id = 0;
    std::int64_t max_target = 0;
  };
  [[nodiscard]] std::optional<std::size_t> drive_at(std::uint16_t id, std::uint16_t base_id) const noexcept;
  /// What a frame that carries commands says to one drive.
  struct Part {
    std::size_t drive = 0;
    MotionWays way = 0;
    std::uint16_t controlword = 0;
    std::int32_t target = 0;
  };
  /// None: no command. In kShared a frame has one part (controlword) or two (targets).
  struct Parts {
    std::array<Part, 2> parts{};
    std::size_t count = 0;
    std::uint8_t size = 0;  // that the frame must have
    [[nodiscard]] std::span<const Part> span() const& noexcept { return {parts.data(), count}; }
    std::span<const Part> span() const&& = delete;  // it would outlive what it shows
  };

  [[nodiscard]] FrameRefusal judge_nmt(const hal::CanFrame& frame) const noexcept;
  [[nodiscard]] FrameRefusal judge_commands(const Parts& parts, bool motion_permitted) const noexcept;
  [[nodiscard]] Parts commands_in(const hal::CanFrame& frame) const noexcept;
  [[nodiscard]] Parts own_command_in(const hal::CanFrame& frame) const noexcept;
  [[nodiscard]] Parts shared_command_in(const hal::CanFrame& frame) const noexcept;
  [[nodiscard]] static bool moves(const Part& part) noexcept;

  std::uint8_t master_node_id_;
  bool shared_;
  std::array<Drive, kWheels> drives_{};
};

}  // namespace ivo::firmware
