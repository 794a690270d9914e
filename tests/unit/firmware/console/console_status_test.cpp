#include "firmware/console/console_status.hpp"

#include <gtest/gtest.h>

#include <chrono>
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
  loop.tracks[1] = {.position = {1.0, 2.0}, .moved_m = 3.0, .before_m = 1.0, .path_ended = true};
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

TEST(ConsoleStatus, SaysWhatTheDialogueStandsAt) {
  LoopStatus loop;
  loop.plan_number = 4;
  loop.preparing = true;
  loop.pause_cause = PauseCause::kBeatLost;
  loop.distance_left_m = 7.5;
  Status status = status_of(loop, 2);
  EXPECT_EQ(status.plan_number, 4U);
  EXPECT_EQ(status.preparing, 1);
  EXPECT_EQ(status.pause_cause, static_cast<std::uint8_t>(PauseCause::kBeatLost));
  EXPECT_EQ(status.watched, 0);
  EXPECT_LT(status.beat_age_s, 0) << "there was none";
  EXPECT_EQ(status.agent[0].left_m, 7.5);
  EXPECT_EQ(status.agent[1].left_m, 0.0) << "nobody knows";
  EXPECT_EQ(status.agent[1].reported, 0U);
  EXPECT_LT(status.agent[1].report_age_s, 0);
  loop.watched = true;
  loop.beat_age = std::chrono::milliseconds(250);
  loop.report_age[1] = std::chrono::seconds(2);
  status = status_of(loop, 2);
  EXPECT_EQ(status.watched, 1);
  EXPECT_EQ(status.beat_age_s, 0.25);
  EXPECT_EQ(status.agent[1].reported, 1U);
  EXPECT_EQ(status.agent[1].report_age_s, 2.0);
  EXPECT_EQ(status.agent[0].reported, 0U);
}

TEST(ConsoleStatus, SaysAFaultInWordsThatEnd) {
  LoopStatus loop;
  loop.mode = Mode::kFault;
  loop.drive_fault = {.reason = drivers::DriveFaultReason::kRebooted, .node_id = 3, .wheel = Wheel::kRearLeft};
  Status status = status_of(loop, 1);
  EXPECT_STREQ(status.fault.data(), "drive 3 (rear left): rebooted");
  EXPECT_EQ(status.fault_node_id, 3);
  EXPECT_EQ(status.fault_wheel, 2);
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
  EXPECT_EQ(offsetof(Status, plan_number), 48U);
  EXPECT_EQ(offsetof(Status, areas_revision), 52U);
  EXPECT_EQ(offsetof(Status, accepted), 56U);
  EXPECT_EQ(offsetof(Status, watched), 60U);
  EXPECT_EQ(offsetof(Status, beat_age_s), 72U);
  EXPECT_EQ(offsetof(Status, generation), 80U);
  EXPECT_EQ(offsetof(Status, expected_time_s), 88U);
  EXPECT_EQ(offsetof(Status, search_time_ns), 112U);
  EXPECT_EQ(offsetof(Status, searched_mass), 120U);
  EXPECT_EQ(offsetof(Status, agent), 136U);
  EXPECT_EQ(offsetof(Status, fault), 520U);
  EXPECT_EQ(offsetof(Status, cycles), 680U);
  EXPECT_EQ(offsetof(Status, messages), 752U);
  EXPECT_EQ(offsetof(Status, answers_dropped), 888U);
  EXPECT_EQ(offsetof(Status, clients), 904U);
}

}  // namespace
}  // namespace ivo::firmware::console
