#include "drivers/bus_watch.hpp"

#include <algorithm>

#include "drivers/canopen/cob_id.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint16_t kFunctionMask = 0x780;

bool is_command(std::uint16_t function) noexcept {
  return function == cob_id::sdo_request(0) || function == 0x200 || function == 0x300 || function == 0x400 ||
         function == 0x500;  // RPDO1 to RPDO4
}

DriveFault fault_of(DriveFaultReason reason, std::uint64_t code) noexcept {
  return {.reason = reason, .code = static_cast<std::uint32_t>(code)};
}

}  // namespace

BusWatch::BusWatch(const Robot& robot) noexcept : master_node_id_(robot.master_node_id) {
  std::ranges::transform(robot.drives, node_ids_.begin(), &DriveParameters::node_id);
}

void BusWatch::open(const hal::CanBus& bus) noexcept {
  lost_before_ = bus.counters().receive_dropped;
  frames_ = 0;
  flooded_cycles_ = 0;
  foreign_ = {};
  fault_ = {};
}

void BusWatch::on_frame(const hal::CanFrame& frame) noexcept {
  ++frames_;
  if (only_a_master_sends(frame.id)) {
    foreign_ = fault_of(DriveFaultReason::kForeignMaster, frame.id);
  }
}

void BusWatch::update(const hal::CanBus& bus, bool synchronous) noexcept {
  const std::uint64_t lost = bus.counters().receive_dropped;
  const hal::BusState state = bus.state();
  const bool passive = state == hal::BusState::kPassive && synchronous;
  flooded_cycles_ = frames_ > kFloodFrames ? flooded_cycles_ + 1 : 0;
  if (hal::lost(state) || passive) {
    fault_ = fault_of(DriveFaultReason::kBusLost, static_cast<std::uint64_t>(state));
  } else if (foreign_.reason != DriveFaultReason::kNone) {
    fault_ = foreign_;
  } else if (flooded_cycles_ >= kFloodCycles) {
    fault_ = fault_of(DriveFaultReason::kBusFlooded, frames_);
  } else if (lost != lost_before_) {
    fault_ = fault_of(DriveFaultReason::kFramesLost, lost - lost_before_);
  } else {
    fault_ = {};
  }
  lost_before_ = lost;
  frames_ = 0;
  foreign_ = {};
}

bool BusWatch::only_a_master_sends(std::uint16_t id) const noexcept {
  if (id == cob_id::kNmt || id == cob_id::kSync || id == cob_id::heartbeat(master_node_id_)) {
    return true;
  }
  const bool to_ours = std::ranges::find(node_ids_, cob_id::node_of(id)) != node_ids_.end();
  return to_ours && is_command(id & kFunctionMask);
}

}  // namespace ivo::drivers
