#include "firmware/console/console_status.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace ivo::firmware::console {
namespace {

TEST(ConsoleStatus, SaysWhatTheLoopShows) {
  LoopStatus loop;
  loop.at = Instant(Duration(123));
  loop.mode = Mode::kSearching;
  loop.plan_ready = true;
  loop.search_started = true;
  loop.finder = 1;
  loop.search_time = Duration(456);
  loop.robot.heading_rad = 0.5;
  loop.planning.generation = 3;
  loop.planning.generations = 9;
  loop.planning.has_plan = true;
  loop.planning.best.expected_time_s = 77.0;
  loop.tracks[1] = {{1.0, 2.0}, 3.0, Duration(), true};
  loop.counters.cycles = 10;
  loop.counters.bus.receive_dropped = 11;
  const Status status = status_of(loop, 2);
  EXPECT_EQ(status.header.kind, Kind::kStatus);
  EXPECT_EQ(status.header.size, sizeof(Status));
  EXPECT_EQ(status.at_ns, 123);
  EXPECT_EQ(status.mode, 3);
  EXPECT_EQ(status.plan_ready, 1);
  EXPECT_EQ(status.search_started, 1);
  EXPECT_EQ(status.finished, 0);
  EXPECT_EQ(status.finder, 1);
  EXPECT_EQ(status.agents, 2);
  EXPECT_EQ(status.search_time_ns, 456);
  EXPECT_EQ(status.heading_rad, 0.5);
  EXPECT_EQ(status.generation, 3);
  EXPECT_EQ(status.generations, 9);
  EXPECT_EQ(status.expected_time_s, 77.0);
  EXPECT_EQ(status.agent[1].x_m, 1.0);
  EXPECT_EQ(status.agent[1].y_m, 2.0);
  EXPECT_EQ(status.agent[1].moved_m, 3.0);
  EXPECT_EQ(status.agent[1].path_ended, 1U);
  EXPECT_EQ(status.agent[2].x_m, 0.0) << "there is no third";
  EXPECT_EQ(status.cycles, 10U);
  EXPECT_EQ(status.receive_dropped, 11U);
  EXPECT_EQ(status.fault[0], '\0');
}

TEST(ConsoleStatus, SaysAFaultInWordsThatEnd) {
  LoopStatus loop;
  loop.mode = Mode::kFault;
  loop.drive_fault = {.reason = drivers::DriveFaultReason::kRebooted, .node_id = 3, .wheel = Wheel::kRearLeft};
  Status status = status_of(loop, 1);
  EXPECT_STREQ(status.fault.data(), "drive 3 (rear left): rebooted");
  EXPECT_EQ(status.fault_node_id, 3);
  const std::string longer(200, 'x');
  loop.drive_fault.step = longer.c_str();
  loop.drive_fault.reason = drivers::DriveFaultReason::kSdoTimedOut;
  status = status_of(loop, 1);
  EXPECT_EQ(status.fault.back(), '\0');
  EXPECT_EQ(status.fault[status.fault.size() - 2], 'x');
}

TEST(ConsoleStatus, SaysWhichStopInputIsPressed) {
  LoopStatus loop;
  loop.stop_held = {.reason = drivers::DriveFaultReason::kStopInput};
  const Status status = status_of(loop, 1);
  EXPECT_EQ(status.stop_held, 1);
  EXPECT_EQ(status.fault_reason, 0);
  EXPECT_NE(status.fault[0], '\0');
}

// Programs in other languages read it by these places.
TEST(ConsoleStatus, LiesWhereOtherProgramsReadIt) {
  EXPECT_EQ(offsetof(Status, at_ns), 16U);
  EXPECT_EQ(offsetof(Status, question), 24U);
  EXPECT_EQ(offsetof(Status, asks), 28U);
  EXPECT_EQ(offsetof(Status, mode), 29U);
  EXPECT_EQ(offsetof(Status, fault_code), 44U);
  EXPECT_EQ(offsetof(Status, generation), 48U);
  EXPECT_EQ(offsetof(Status, expected_time_s), 56U);
  EXPECT_EQ(offsetof(Status, search_time_ns), 80U);
  EXPECT_EQ(offsetof(Status, agent), 96U);
  EXPECT_EQ(offsetof(Status, fault), 352U);
  EXPECT_EQ(offsetof(Status, cycles), 512U);
  EXPECT_EQ(offsetof(Status, messages), 584U);
  EXPECT_EQ(offsetof(Status, answers_dropped), 688U);
  EXPECT_EQ(offsetof(Status, clients), 704U);
}

}  // namespace
}  // namespace ivo::firmware::console
