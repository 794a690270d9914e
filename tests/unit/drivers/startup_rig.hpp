// The start-up of one drive against a bare node, cycle by cycle.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "config/rates.hpp"
#include "drivers/drive_fault_text.hpp"
#include "drivers/drive_startup.hpp"
#include "tests/unit/drivers/bare_node.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {

class StartupRig {
 public:
  explicit StartupRig(const Robot& robot = test_robot(), Wheel wheel = Wheel::kRearLeft)
      : node(robot.drives[static_cast<std::size_t>(wheel)].node_id), startup(robot, wheel) {}

  void cycle() {
    startup.update(now);
    if (const auto frame = startup.next_frame(now)) {
      log.push_back(*frame);
      node.on_frame(*frame, now);
    }
    now += rates::kCycle;
    for (const hal::CanFrame& frame : node.update(now)) {
      deliver(frame);
    }
  }

  void deliver(const hal::CanFrame& frame) {
    if (frame.id == cob_id::sdo_answer(node.node_id())) {
      startup.on_sdo(frame);
    } else if (const auto state = parse_heartbeat(frame)) {
      *state == NmtState::kBootUp ? startup.on_boot_up() : startup.on_heartbeat(*state);
    }
  }

  /// From open to Operational or failure, at most two minutes.
  bool run() {
    startup.open();
    for (const Instant end = now + std::chrono::minutes(2); now < end;) {
      cycle();
      if (startup.phase() == DriveStartup::Phase::kConfigured) {
        startup.start();
      }
      if (startup.phase() == DriveStartup::Phase::kOperational || startup.phase() == DriveStartup::Phase::kFailed) {
        break;
      }
    }
    return startup.phase() == DriveStartup::Phase::kOperational;
  }

  [[nodiscard]] std::string failure() const { return describe(startup.fault()); }
  /// Requests that were sent to an object, other than reads.
  [[nodiscard]] std::vector<std::uint32_t> written(std::uint16_t index, std::uint8_t sub) const {
    std::vector<std::uint32_t> values;
    for (const SdoMessage& write : node.writes) {
      if (write.address == ObjectAddress{index, sub}) {
        values.push_back(write.data);
      }
    }
    return values;
  }

  Instant now{};
  BareNode node;
  DriveStartup startup;
  std::vector<hal::CanFrame> log;
};

}  // namespace ivo::drivers
