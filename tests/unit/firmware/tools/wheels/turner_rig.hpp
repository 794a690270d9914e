// A wheel turner, four simulated drives that may be another base than the robot file says, and a technician's finger,
// in simulated time.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "drivers/canopen/little_endian.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "firmware/tools/wheels/wheel_turner.hpp"
#include "hal/sim/digital_inputs.hpp"
#include "hal/sim/manual_clock.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::firmware {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

inline Robot geared_robot() {
  Robot robot;
  for (DriveParameters& drive : robot.drives) {
    drive.gear_ratio = 20.0;
  }
  return robot;
}

class TurnerRig {
 public:
  explicit TurnerRig(const Robot& file = geared_robot(), const Robot& base = geared_robot(),
                     const drivers::SimDrives::Scripts& scripts = {})
      : robot(file),
        truth(base),
        drives(bus.port(1), truth, drivers::SimDrives::TimeFrom::kClock, scripts),
        turner(bus.port(0), robot, &inputs) {
    drives.open();
    turner.open(clock.now());
  }

  hal::SimDigitalInputs inputs;  // input 0: emergency stop, where the robot file has one

  const TurnStatus& cycle(const WheelTurner::Keys& keys = {}, std::int64_t skipped = 0) {
    const TurnStatus& status = turner.cycle(clock.now(), skipped, keys);
    clock.sleep_until(clock.now() + rates::kCycle);
    if (drives_run) {
      drives.update(clock.now());
    }
    listen();
    return status;
  }

  /// Nobody touches a key.
  void run(Duration time) {
    for (const Instant end = clock.now() + time; clock.now() < end;) {
      cycle();
    }
  }

  /// The key is held for `time`: a press, half a second, repeats.
  void hold(Duration time) {
    const Instant begin = clock.now();
    Instant next = begin;
    while (clock.now() - begin < time) {
      const bool key = clock.now() >= next;
      if (key) {
        next += next == begin ? 500ms : 30ms;
      }
      cycle({.hold = key});
    }
  }

  bool run_until(TurnPhase phase) {
    for (int i = 0; i < 10'000; ++i) {
      if (cycle().phase == phase) {
        return true;
      }
    }
    return false;
  }

  /// Turns that the wheel really made, by the base that it is; positive forward.
  [[nodiscard]] double turns(Wheel wheel) {
    const DriveParameters& drive = truth.drives[static_cast<std::size_t>(wheel)];
    return drives.drive(wheel).motion().position() * drive.sign / (drive.counts_per_turn * drive.gear_ratio);
  }
  [[nodiscard]] bool at_rest(Wheel wheel) { return drives.drive(wheel).motion().at_rest(); }
  [[nodiscard]] bool any_power() {
    for (const Wheel wheel : {Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearLeft, Wheel::kRearRight}) {
      const auto state = drives.drive(wheel).power_state();
      if (state == drivers::cia402::PowerState::kSwitchedOn ||
          state == drivers::cia402::PowerState::kOperationEnabled ||
          state == drivers::cia402::PowerState::kQuickStopActive) {
        return true;
      }
    }
    return false;
  }
  /// The largest target that went to `node_id`, without a sign.
  [[nodiscard]] std::int64_t largest_target(std::uint8_t node_id) const {
    std::int64_t largest = 0;
    for (const hal::CanFrame& frame : log) {
      if (frame.id == 0x200 + node_id) {
        const auto target = static_cast<std::int32_t>(
            drivers::load<std::uint32_t>(std::span<const std::uint8_t>(frame.data).subspan(2)));
        largest = std::max(largest, std::abs(std::int64_t{target}));
      }
    }
    return largest;
  }
  void inject(const hal::CanFrame& frame) { bus.port(2).send({&frame, 1}, clock.now()); }

  Robot robot;  ///< what the file says
  Robot truth;  ///< what the base is
  hal::VirtualBus bus;
  hal::ManualClock clock;
  drivers::SimDrives drives;
  WheelTurner turner;
  bool drives_run = true;
  std::vector<hal::CanFrame> log;

 private:
  void listen() {
    std::array<hal::ReceivedFrame, 64> frames;
    const std::size_t count = bus.port(3).receive(frames, clock.now());
    for (std::size_t i = 0; i < count; ++i) {
      log.push_back(frames[i].frame);
    }
  }
};

}  // namespace ivo::firmware
