#include "drivers/canopen/bus_load.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "config/base/contract.hpp"
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/frame_bits.hpp"
#include "drivers/canopen/pdo.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint8_t kTwoTargetsBytes = 8;
constexpr std::uint8_t kControlwordAloneBytes = 2;
constexpr std::uint8_t kSdoBytes = 8;

double share(double bits, Duration time, std::uint32_t bit_rate_bps) noexcept {
  return bits / (seconds(time) * bit_rate_bps);
}

void put(BusSchedule& schedule, const PeriodicFrame& frame) noexcept { IVO_CONTRACT(schedule.push_back(frame)); }

}  // namespace

FrameKind kind_of(std::uint16_t id) noexcept {
  if (id == cob_id::kNmt) {
    return FrameKind::kNmt;
  }
  if (id == cob_id::kSync) {
    return FrameKind::kSync;
  }
  if (cob_id::node_of(id) == 0) {
    return FrameKind::kOther;
  }
  switch (id & 0x780) {
    case 0x080:
      return FrameKind::kEmcy;
    case 0x180:
    case 0x280:
    case 0x380:
    case 0x480:
      return FrameKind::kTpdo;
    case 0x200:
    case 0x300:
    case 0x400:
    case 0x500:
      return FrameKind::kRpdo;
    case 0x580:
    case 0x600:
      return FrameKind::kSdo;
    case 0x700:
      return FrameKind::kHeartbeat;
    default:
      return FrameKind::kOther;
  }
}

BusSchedule schedule_of(const Robot& robot) noexcept {
  BusSchedule schedule;
  put(schedule, {cob_id::kSync, 0, robot.cycle});
  for (const DriveParameters& drive : robot.drives) {
    put(schedule, {cob_id::tpdo1(drive.node_id), kPdoBytes, robot.cycle, true});
    put(schedule, {cob_id::heartbeat(drive.node_id), 1, rates::kDriveHeartbeat});
    if (robot.pdo_layout == PdoLayout::kOwn) {
      put(schedule, {cob_id::rpdo1(drive.node_id), kPdoBytes, robot.cycle});
    } else {
      put(schedule, {cob_id::rpdo1(drive.node_id), kControlwordAloneBytes, rates::kControlwordRefresh});
    }
  }
  if (robot.pdo_layout == PdoLayout::kShared) {
    for (std::size_t first = 0; first < robot.drives.size(); first += 2) {
      put(schedule, {cob_id::of(0x300, robot.drives[first].node_id), kTwoTargetsBytes, robot.cycle});
    }
  }
  put(schedule, {cob_id::heartbeat(robot.master_node_id), 1, rates::kMasterHeartbeat});
  return schedule;
}

std::array<PeriodicFrame, 2> sdo_transfer_every(Duration period, std::uint8_t node_id) noexcept {
  return {{{cob_id::sdo_answer(node_id), kSdoBytes, period}, {cob_id::sdo_request(node_id), kSdoBytes, period}}};
}

BusLoad load_of(std::span<const PeriodicFrame> frames, std::uint32_t bit_rate_bps) noexcept {
  BusLoad load;
  for (const PeriodicFrame& frame : frames) {
    load.unstuffed += share(unstuffed_bits(frame.bytes), frame.period, bit_rate_bps);
    load.worst += share(longest_bits(frame.bytes), frame.period, bit_rate_bps);
  }
  return load;
}

bool fits(const Robot& robot) noexcept {
  return load_of(schedule_of(robot).span(), robot.bit_rate_bps).worst <= kMostWorstLoad;
}

void LoadMeter::pass_to(std::int64_t ms) noexcept {
  const auto bits_in = [this](std::int64_t when) -> std::int64_t& {
    return bits_in_ms_[static_cast<std::size_t>(when) % kLongMs];
  };
  constexpr auto kShort = static_cast<std::int64_t>(kShortMs);
  if (ms - ms_ >= static_cast<std::int64_t>(kLongMs)) {
    bits_in_ms_.fill(0);
    short_bits_ = 0;
    long_bits_ = 0;
    ms_ = ms;
  }
  while (ms_ < ms) {
    ++ms_;
    short_bits_ -= ms_ >= kShort ? bits_in(ms_ - kShort) : 0;
    long_bits_ -= bits_in(ms_);  // of kLongMs ago
    bits_in(ms_) = 0;
  }
}

void LoadMeter::add(Instant at, const hal::CanFrame& frame) noexcept {
  if (std::accumulate(frames_.begin(), frames_.end(), std::uint64_t{0}) == 0) {
    first_ = at;
    last_ = at;
  }
  last_ = std::max(last_, at);
  pass_to((last_ - first_) / std::chrono::milliseconds(1));
  const int bits = bits_on_wire(frame);
  bits_in_ms_[static_cast<std::size_t>(ms_) % kLongMs] += bits;
  short_bits_ += bits;
  long_bits_ += bits;
  most_short_bits_ = std::max(most_short_bits_, short_bits_);
  most_long_bits_ = std::max(most_long_bits_, long_bits_);
  const auto kind = static_cast<std::size_t>(kind_of(frame.id));
  ++frames_[kind];
  bits_[kind] += bits;
}

LoadMeter::Figures LoadMeter::figures() const noexcept {
  using std::chrono::milliseconds;
  Figures figures;
  figures.time = last_ - first_;
  figures.worst_10ms = share(static_cast<double>(most_short_bits_), milliseconds(kShortMs), bit_rate_bps_);
  figures.worst_100ms = share(static_cast<double>(most_long_bits_), milliseconds(kLongMs), bit_rate_bps_);
  for (std::size_t kind = 0; kind < kFrameKinds; ++kind) {
    figures.frames += frames_[kind];
    figures.kinds[kind].frames = frames_[kind];
    if (figures.time > Duration::zero()) {
      figures.kinds[kind].load = share(static_cast<double>(bits_[kind]), figures.time, bit_rate_bps_);
      figures.mean += figures.kinds[kind].load;
    }
  }
  return figures;
}

}  // namespace ivo::drivers
