#include "firmware/safety/frame_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace ivo::firmware {
namespace {

// Stated here and not taken from the drivers: a mistake there must not open the door here.
constexpr std::uint16_t kNmtId = 0x000;   // CiA 301, 7.3.5, predefined connection set
constexpr std::uint16_t kSyncId = 0x080;  // ditto
constexpr std::array<std::uint16_t, 4> kRpdoIds{0x200, 0x300, 0x400, 0x500};  // ditto, + node-id
constexpr std::uint16_t kSdoRequestId = 0x600;                                // ditto, + node-id
constexpr std::uint16_t kHeartbeatId = 0x700;                                 // ditto, + node-id
constexpr std::uint8_t kLastNodeId = 127;

constexpr std::uint8_t kNmtSize = 2;
constexpr std::uint8_t kSyncSize = 0;
constexpr std::uint8_t kHeartbeatSize = 1;
constexpr std::uint8_t kSdoSize = 8;
constexpr std::uint8_t kCommandSize = 6;      // {6040h, 60FFh}
constexpr std::uint8_t kControlwordSize = 2;  // {6040h}
constexpr std::uint8_t kTargetsSize = 8;      // {60FFh, 60FFh}

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

constexpr std::array<std::string_view, kFrameRefusals> kFrameRefusalNames{
    "none",
    "COB-ID not on the list",
    "wrong size",
    "NMT command not ours to send",
    "motion by SDO",
    "target velocity too high",
    "motion not permitted",
    "SDO in motion",
    "another wheel's motion was refused",
};

std::uint16_t controlword_at(const hal::CanFrame& frame, std::size_t at) noexcept {
  return static_cast<std::uint16_t>(frame.data[at] | frame.data[at + 1] << 8);
}

std::int32_t target_at(const hal::CanFrame& frame, std::size_t at) noexcept {
  const auto& d = frame.data;
  const std::uint32_t target = static_cast<std::uint32_t>(d[at]) | static_cast<std::uint32_t>(d[at + 1]) << 8 |
                               static_cast<std::uint32_t>(d[at + 2]) << 16 |
                               static_cast<std::uint32_t>(d[at + 3]) << 24;
  return static_cast<std::int32_t>(target);
}

// CiA 402-2, commands in the controlword: enable operation is bits 0 to 3 set, bit 7 clear.
bool enables_operation(std::uint16_t controlword) noexcept { return (controlword & 0x8F) == 0x0F; }

MotionWays own_way(std::size_t drive) noexcept { return static_cast<MotionWays>(1U << drive); }
MotionWays shared_way(std::size_t drive) noexcept { return static_cast<MotionWays>(1U << (kWheels + drive)); }

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

std::string_view name_of(FrameRefusal refusal) noexcept {
  return kFrameRefusalNames[static_cast<std::size_t>(refusal)];
}

FrameRules::FrameRules(const Robot& robot) noexcept
    : master_node_id_(robot.master_node_id), shared_(robot.pdo_layout == PdoLayout::kShared) {
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
    if (frame.size != kSdoSize) {
      return FrameRefusal::kWrongSize;
    }
    return motion_permitted ? FrameRefusal::kSdoInMotion : judge_sdo(frame);
  }
  if (const Parts parts = commands_in(frame); parts.count > 0) {
    return frame.size == parts.size ? judge_commands(parts, motion_permitted) : FrameRefusal::kWrongSize;
  }
  return FrameRefusal::kNotListed;
}

MotionWays FrameRules::moved_by(const hal::CanFrame& frame) const noexcept {
  MotionWays ways = 0;
  const Parts parts = commands_in(frame);
  for (const Part& part : parts.span()) {
    ways = static_cast<MotionWays>(ways | (moves(part) ? part.way : 0));
  }
  return ways;
}

bool FrameRules::moves(const Part& part) noexcept { return part.target != 0 || enables_operation(part.controlword); }

FrameRules::Parts FrameRules::commands_in(const hal::CanFrame& frame) const noexcept {
  return shared_ ? shared_command_in(frame) : own_command_in(frame);
}

FrameRules::Parts FrameRules::own_command_in(const hal::CanFrame& frame) const noexcept {
  Parts parts;
  for (const std::uint16_t base_id : kRpdoIds) {
    if (const auto drive = drive_at(frame.id, base_id)) {
      parts.parts[0] = {*drive, own_way(*drive), controlword_at(frame, 0), target_at(frame, 2)};
      parts.count = 1;
      parts.size = kCommandSize;
    }
  }
  return parts;
}

FrameRules::Parts FrameRules::shared_command_in(const hal::CanFrame& frame) const noexcept {
  Parts parts;
  if (const auto drive = drive_at(frame.id, kRpdoIds[0])) {
    parts.parts[0] = {*drive, own_way(*drive), controlword_at(frame, 0), 0};
    parts.count = 1;
    parts.size = kControlwordSize;
  } else if (const auto first = drive_at(frame.id, kRpdoIds[1]); first && *first % 2 == 0) {
    parts.parts[0] = {*first, shared_way(*first), 0, target_at(frame, 0)};
    parts.parts[1] = {*first + 1, shared_way(*first + 1), 0, target_at(frame, 4)};
    parts.count = 2;
    parts.size = kTargetsSize;
  }
  return parts;
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

FrameRefusal FrameRules::judge_commands(const Parts& parts, bool motion_permitted) const noexcept {
  bool moving = false;
  for (const Part& part : parts.span()) {
    if (std::abs(static_cast<std::int64_t>(part.target)) > drives_[part.drive].max_target) {
      return FrameRefusal::kTargetTooHigh;
    }
    moving = moving || moves(part);
  }
  return moving && !motion_permitted ? FrameRefusal::kMotionNotPermitted : FrameRefusal::kNone;
}

}  // namespace ivo::firmware
