// Nothing here allocates, in any call of a cycle. What this says beyond "it runs" it says in the preset noheap.
#include <gtest/gtest.h>

#include <array>
#include <chrono>

#include "config/rates.hpp"
#include "drivers/drive_group.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "hal/sim/virtual_bus.hpp"
#include "tests/support/heap_trap.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

TEST(DriveGroup, StartsMovesFailsAndStartsAgainWithoutAHeap) {
  const Robot robot = test_robot();
  hal::VirtualBus bus;
  SimDrives drives(bus.port(1), robot, SimDrives::TimeFrom::kClock);
  drives.open();
  bool moved = false;
  bool failed = false;
  bool ready_again = false;
  {
    const test::NoHeap no_heap;
    DriveGroup group(bus.port(0), robot);
    std::array<hal::ReceivedFrame, 64> frames{};
    Instant now{};
    group.open(now);
    GroupFeedback seen;
    const auto run = [&](Duration time, bool enable, double radps, bool drives_run) {
      for (const Instant end = now + time; now < end; now += rates::kCycle) {
        const std::size_t count = bus.port(0).receive(frames, now);
        for (std::size_t i = 0; i < count; ++i) {
          group.on_frame(frames[i]);
        }
        seen = group.update(now);
        group.write(now, enable, {{radps, radps, radps, radps}});
        if (drives_run) {
          // The drives are another machine's program: what they do is not held against the group.
          drives.update(now);
        }
      }
    };
    run(std::chrono::seconds(2), false, 0.0, true);
    run(std::chrono::seconds(2), true, 2.0, true);
    moved = seen.state == GroupState::kEnabled && seen.radps[0] > 1.0;
    run(std::chrono::milliseconds(500), true, 2.0, false);
    failed = seen.state == GroupState::kFault;
    run(std::chrono::seconds(2), false, 0.0, true);
    group.reset_fault();
    run(std::chrono::seconds(4), false, 0.0, true);
    ready_again = seen.state == GroupState::kReady;
    group.stop(now);
  }
  EXPECT_TRUE(moved);
  EXPECT_TRUE(failed);
  EXPECT_TRUE(ready_again);
}

}  // namespace
}  // namespace ivo::drivers
