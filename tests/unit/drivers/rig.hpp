// A robot's four simulated drives, a bus, a clock and the group under test, cycle by cycle in one process.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "config/rates.hpp"
#include "drivers/canopen/little_endian.hpp"
#include "drivers/drive_group.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "hal/sim/manual_clock.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::drivers {

inline Robot test_robot() {
  Robot robot;
  for (std::size_t i = 0; i < robot.drives.size(); ++i) {
    robot.drives[i].node_id = static_cast<std::uint8_t>(i + 1);
    robot.drives[i].sign = i % 2 == 0 ? 1 : -1;
    robot.drives[i].gear_ratio = 20.0;
  }
  return robot;
}

/// The same with shared targets, at 1 kHz.
inline Robot shared_robot() {
  Robot robot = test_robot();
  robot.pdo_layout = PdoLayout::kShared;
  robot.cycle = std::chrono::milliseconds(1);
  return robot;
}

/// Takes the first `room` frames of a send, as a transmit queue that is almost full, and drops the rest.
class NarrowBus final : public hal::CanBus {
 public:
  explicit NarrowBus(hal::CanBus& inner) : inner_(inner) {}
  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override {
    return inner_.receive(frames, now);
  }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override {
    const std::size_t taken = std::min(frames.size(), room);
    dropped_ += frames.size() - taken;
    return inner_.send(frames.first(taken), now);
  }
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override {
    hal::BusCounters counters = inner_.counters();
    counters.send_dropped += dropped_;
    counters.send_refused += refused;
    return counters;
  }

  std::size_t room = 1000;
  std::uint64_t refused = 0;  ///< as a bus that judges frames would count

 private:
  hal::CanBus& inner_;
  std::uint64_t dropped_ = 0;
};

class Rig {
 public:
  explicit Rig(const SimDrives::Scripts& scripts = {}, const Robot& robot_parameters = test_robot(),
               SimDrives::TimeFrom time_from = SimDrives::TimeFrom::kClock, const EdsDictionary& eds = ivo_drive_eds())
      : robot(robot_parameters),
        drives(bus.port(1), robot, time_from, scripts, {&eds, &eds, &eds, &eds}),
        group(narrow, robot) {
    drives.open();
    group.open(clock.now());
  }

  /// One cycle of the loop: receive, update, write; the drives answer; 2 ms pass.
  const GroupFeedback& cycle() {
    std::array<hal::ReceivedFrame, 64> frames;
    const std::size_t count = bus.port(0).receive(frames, clock.now());
    for (std::size_t i = 0; i < count; ++i) {
      group.on_frame(frames[i]);
    }
    const GroupFeedback& seen = group.update(clock.now());
    group.write(clock.now(), enable, targets);
    clock.sleep_until(clock.now() + rates::kCycle);
    if (drives_run) {
      drives.update(clock.now());
    }
    listen();
    feedback = seen;
    return feedback;
  }

  void run(Duration time) {
    for (const Instant end = clock.now() + time; clock.now() < end;) {
      cycle();
    }
  }

  /// Cycles until `state`, at most 20 s; false when it never came.
  bool run_until(GroupState state) {
    for (int i = 0; i < 10'000; ++i) {
      if (cycle().state == state) {
        return true;
      }
    }
    return false;
  }

  bool enable_all() {
    if (!run_until(GroupState::kReady)) {
      return false;
    }
    enable = true;
    return run_until(GroupState::kEnabled);
  }

  bool drive_at(double radps) {
    targets.radps.fill(radps);
    if (!enable_all()) {
      return false;
    }
    run(std::chrono::milliseconds(500));
    return feedback.state == GroupState::kEnabled;
  }

  /// A frame from a stranger on the bus.
  void inject(const hal::CanFrame& frame) { bus.port(2).send({&frame, 1}, clock.now()); }

  /// The last RPDO1 that went to `node_id`.
  [[nodiscard]] hal::CanFrame last_command(std::uint8_t node_id) const {
    for (auto frame = log.rbegin(); frame != log.rend(); ++frame) {
      if (frame->id == 0x200 + node_id) {
        return *frame;
      }
    }
    return {};
  }

  Robot robot;
  hal::VirtualBus bus;
  NarrowBus narrow{bus.port(0)};
  hal::ManualClock clock;
  SimDrives drives;
  DriveGroup group;
  bool enable = false;
  bool drives_run = true;
  WheelTargets targets;
  GroupFeedback feedback;
  std::vector<hal::CanFrame> log;  // every frame on the bus

 private:
  void listen() {
    std::array<hal::ReceivedFrame, 64> frames;
    const std::size_t count = bus.port(3).receive(frames, clock.now());
    for (std::size_t i = 0; i < count; ++i) {
      log.push_back(frames[i].frame);
    }
  }
};

inline constexpr std::array<Wheel, kWheels> kAll{Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearLeft,
                                                 Wheel::kRearRight};

inline bool any_enabled(Rig& rig) {
  return std::any_of(kAll.begin(), kAll.end(), [&](Wheel wheel) {
    return rig.drives.drive(wheel).power_state() == cia402::PowerState::kOperationEnabled;
  });
}

inline bool all_at_rest(Rig& rig) {
  return std::all_of(kAll.begin(), kAll.end(), [&](Wheel wheel) { return rig.drives.drive(wheel).motion().at_rest(); });
}

inline std::uint16_t controlword_of(const hal::CanFrame& frame) {
  return static_cast<std::uint16_t>(frame.data[0] | frame.data[1] << 8);
}

inline std::int32_t target_of(const hal::CanFrame& frame) {
  return static_cast<std::int32_t>(load<std::uint32_t>(std::span<const std::uint8_t>(frame.data).subspan(2)));
}

/// All four got zero and quick stop (or voltage off) in the last cycle.
inline void expect_stopped_command(const Rig& rig) {
  for (std::uint8_t node = 1; node <= 4; ++node) {
    const hal::CanFrame command = rig.last_command(node);
    EXPECT_EQ(target_of(command), 0) << "node " << int{node};
    EXPECT_TRUE(controlword_of(command) == 0x02 || controlword_of(command) == 0x00) << "node " << int{node};
  }
}

}  // namespace ivo::drivers
