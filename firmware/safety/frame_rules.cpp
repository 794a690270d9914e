#include "firmware/safety/frame_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace ivo::firmware {
namespace {

// Stated here and not taken from the drivers: a mistake there must not open the door here.
constexpr std::uint16_t kNmtId = 0x000;         // CiA 301, 7.3.5, predefined connection set
constexpr std::uint16_t kSyncId = 0x080;        // ditto
constexpr std::uint16_t kRpdo1Id = 0x200;       // ditto, + node-id
constexpr std::uint16_t kSdoRequestId = 0x600;  // ditto, + node-id
constexpr std::uint16_t kHeartbeatId = 0x700;   // ditto, + node-id
constexpr std::uint8_t kLastNodeId = 127;

constexpr std::uint8_t kNmtSize = 2;
constexpr std::uint8_t kSyncSize = 0;
constexpr std::uint8_t kHeartbeatSize = 1;
constexpr std::uint8_t kSdoSize = 8;
constexpr std::uint8_t kRpdo1Size = 6;

// CiA 301, 7.2.8.3: start, stop, pre-operational, reset node, reset communication.
constexpr std::array<std::uint8_t, 5> kNmtCommands{0x01, 0x02, 0x80, 0x81, 0x82};

// CiA 301, 7.2.4.3: the command specifier is the upper three bits of an SDO request; expedited is bit 1 of an initiate.
constexpr std::uint8_t kSpecifierMask = 0xE0;
constexpr std::uint8_t kDownload = 0x20;
constexpr std::uint8_t kBlockDownload = 0xC0;
constexpr std::uint8_t kExpedited = 0x02;
constexpr std::uint8_t kWriteTwoBytes = 0x2B;  // expedited, size given

constexpr std::uint16_t kControlword = 0x6040;     // CiA 402-2
constexpr std::uint16_t kTargetVelocity = 0x60FF;  // CiA 402-2

constexpr std::array<std::string_view, kFrameRefusals> kNames{
    "none",          "COB-ID not on the list",   "wrong size",           "NMT command not ours to send",
    "motion by SDO", "target velocity too high", "motion not permitted",
};

struct Command {
  std::uint16_t controlword;
  std::int32_t target;
};

Command command_in(const hal::CanFrame& frame) noexcept {
  const auto& d = frame.data;
  const std::uint32_t target = static_cast<std::uint32_t>(d[2]) | static_cast<std::uint32_t>(d[3]) << 8 |
                               static_cast<std::uint32_t>(d[4]) << 16 | static_cast<std::uint32_t>(d[5]) << 24;
  return {static_cast<std::uint16_t>(d[0] | d[1] << 8), static_cast<std::int32_t>(target)};
}

// CiA 402-2, commands in the controlword: enable operation is bits 0 to 3 set, bit 7 clear.
bool enables_operation(std::uint16_t controlword) noexcept { return (controlword & 0x8F) == 0x0F; }

bool moves(const Command& command) noexcept { return command.target != 0 || enables_operation(command.controlword); }

// The driver rounds to the nearest unit, so the largest speed may come out one unit higher than it is.
std::int64_t max_target_of(const BaseParameters& base, const DriveParameters& drive) noexcept {
  const double units = std::ceil(std::abs(base.max_wheel_radps * drive.gear_ratio * drive.velocity_per_radps));
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  return std::isfinite(units) ? static_cast<std::int64_t>(std::min(units, kMost)) : 0;
}

FrameRefusal judge_sdo(const hal::CanFrame& frame) noexcept {
  const auto& d = frame.data;
  const std::uint8_t specifier = d[0] & kSpecifierMask;
  const auto index = static_cast<std::uint16_t>(d[1] | d[2] << 8);
  if (specifier != kDownload && specifier != kBlockDownload) {
    return FrameRefusal::kNone;
  }
  const bool zero = std::all_of(d.begin() + 4, d.end(), [](std::uint8_t byte) { return byte == 0; });
  const bool disables_voltage = d[0] == kWriteTwoBytes && d[3] == 0 && zero;
  const bool writes_zero = specifier == kDownload && (d[0] & kExpedited) != 0 && zero;
  const bool moves = (index == kControlword && !disables_voltage) || (index == kTargetVelocity && !writes_zero);
  return moves ? FrameRefusal::kMotionBySdo : FrameRefusal::kNone;
}

FrameRefusal unless(bool right_size, FrameRefusal verdict) noexcept {
  return right_size ? verdict : FrameRefusal::kWrongSize;
}

}  // namespace

std::string_view name_of(FrameRefusal refusal) noexcept { return kNames[static_cast<std::size_t>(refusal)]; }

FrameRules::FrameRules(const Robot& robot) noexcept : master_node_id_(robot.master_node_id) {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    drives_[i] = {robot.drives[i].node_id, max_target_of(robot.base, robot.drives[i])};
  }
}

FrameRefusal FrameRules::judge(const hal::CanFrame& frame, bool motion_permitted) const noexcept {
  if (frame.id == kNmtId) {
    return frame.size == kNmtSize ? judge_nmt(frame) : FrameRefusal::kWrongSize;
  }
  if (frame.id == kSyncId) {
    return unless(frame.size == kSyncSize, FrameRefusal::kNone);
  }
  if (frame.id == kHeartbeatId + master_node_id_ && master_node_id_ >= 1 && master_node_id_ <= kLastNodeId) {
    return unless(frame.size == kHeartbeatSize, FrameRefusal::kNone);
  }
  if (drive_at(frame.id, kSdoRequestId)) {
    return frame.size == kSdoSize ? judge_sdo(frame) : FrameRefusal::kWrongSize;
  }
  if (const auto drive = drive_at(frame.id, kRpdo1Id)) {
    return frame.size == kRpdo1Size ? judge_command(frame, drives_[*drive], motion_permitted)
                                    : FrameRefusal::kWrongSize;
  }
  return FrameRefusal::kNotListed;
}

std::optional<std::size_t> FrameRules::drive_moved_by(const hal::CanFrame& frame) const noexcept {
  const auto drive = drive_at(frame.id, kRpdo1Id);
  return drive && moves(command_in(frame)) ? drive : std::nullopt;
}

std::optional<std::size_t> FrameRules::drive_at(std::uint16_t id, std::uint16_t base_id) const noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const std::uint8_t node_id = drives_[i].node_id;
    if (node_id >= 1 && node_id <= kLastNodeId && id == base_id + node_id) {
      return i;
    }
  }
  return std::nullopt;
}

FrameRefusal FrameRules::judge_nmt(const hal::CanFrame& frame) const noexcept {
  const bool known = std::find(kNmtCommands.begin(), kNmtCommands.end(), frame.data[0]) != kNmtCommands.end();
  const bool ours = frame.data[1] == 0 || drive_at(frame.data[1], 0).has_value();
  return known && ours ? FrameRefusal::kNone : FrameRefusal::kNmtCommand;
}

FrameRefusal FrameRules::judge_command(const hal::CanFrame& frame, const Drive& drive,
                                       bool motion_permitted) const noexcept {
  const Command command = command_in(frame);
  if (std::abs(static_cast<std::int64_t>(command.target)) > drive.max_target) {
    return FrameRefusal::kTargetTooHigh;
  }
  return moves(command) && !motion_permitted ? FrameRefusal::kMotionNotPermitted : FrameRefusal::kNone;
}

}  // namespace ivo::firmware
