#include "drivers/bus_watch.hpp"

#include <algorithm>

#include "drivers/canopen/bus_ids.hpp"

namespace ivo::drivers {
namespace {

DriveFault fault_of(DriveFaultReason reason, std::uint64_t code) noexcept {
  return {.reason = reason, .code = static_cast<std::uint32_t>(code)};
}

}  // namespace

BusWatch::BusWatch(const Robot& robot) noexcept : master_node_id_(robot.master_node_id) {
  std::ranges::transform(robot.drives, node_ids_.begin(), &DriveParameters::node_id);
}

void BusWatch::open(const hal::CanBus& bus) noexcept {
  lost_before_ = bus.counters().receive_dropped;
  refused_before_ = bus.counters().send_refused;
  frames_ = 0;
  flooded_cycles_ = 0;
  foreign_ = {};
  fault_ = {};
}

void BusWatch::on_frame(const hal::CanFrame& frame) noexcept {
  ++frames_;
  if (only_a_master_sends(frame.id, node_ids_, master_node_id_)) {
    foreign_ = fault_of(DriveFaultReason::kForeignMaster, frame.id);
  }
}

void BusWatch::update(const hal::CanBus& bus, bool synchronous) noexcept {
  const hal::BusCounters counters = bus.counters();
  const std::uint64_t lost = counters.receive_dropped;
  const std::uint64_t refused = counters.send_refused;
  const hal::BusState state = bus.state();
  const bool passive = state == hal::BusState::kPassive && synchronous;
  flooded_cycles_ = frames_ > kFloodFrames ? flooded_cycles_ + 1 : 0;
  if (hal::lost(state) || passive) {
    fault_ = fault_of(DriveFaultReason::kBusLost, static_cast<std::uint64_t>(state));
  } else if (foreign_.reason != DriveFaultReason::kNone) {
    fault_ = foreign_;
  } else if (refused != refused_before_) {
    fault_ = fault_of(DriveFaultReason::kFrameRefused, refused - refused_before_);
  } else if (flooded_cycles_ >= kFloodCycles) {
    fault_ = fault_of(DriveFaultReason::kBusFlooded, frames_);
  } else if (lost != lost_before_) {
    fault_ = fault_of(DriveFaultReason::kFramesLost, lost - lost_before_);
  } else {
    fault_ = {};
  }
  lost_before_ = lost;
  refused_before_ = refused;
  frames_ = 0;
  foreign_ = {};
}

}  // namespace ivo::drivers
