#include "firmware/tools/doctor/drive_checks.hpp"

#include <memory>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "hal/sim/manual_clock.hpp"
#include "hal/sim/virtual_bus.hpp"
#include "tests/unit/firmware/tools/doctor/machine_folder.hpp"

namespace ivo::firmware::doctor {
namespace {

using std::chrono_literals::operator""ms;

/// Simulated drives of `base`, and what a scan for `robot` says of them; somebody else sends `other` all the while.
Group scanned(const Robot& base, const Robot& robot, const std::optional<hal::CanFrame>& other = {}) {
  hal::VirtualBus bus;
  hal::ManualClock clock;
  drivers::SimDrives drives(bus.port(1), base, drivers::SimDrives::TimeFrom::kClock);
  drives.open();
  const auto scan = std::make_unique<NodeScan>(bus.port(0), robot, NodeScan::everyone());
  for (int i = 0; i < 10'000 && !scan->done(); ++i) {
    scan->cycle(clock.now());
    clock.sleep_until(clock.now() + 2ms);
    if (other) {
      bus.port(2).send({&*other, 1}, clock.now());
    }
    drives.update(clock.now());
  }
  EXPECT_TRUE(scan->done());
  Group group = drive_checks(*scan, robot, "can0");
  expect_remedies(group);
  return group;
}

TEST(DriveChecks, FourThatAnswerAreWell) {
  const Group group = scanned({}, {});
  ASSERT_EQ(group.findings.size(), 1U);
  EXPECT_EQ(of(group, "answer").state, State::kOk);
  EXPECT_EQ(of(group, "answer").found.find("all four: node-ids 1, 2, 3, 4;"), 0U);
}

TEST(DriveChecks, OneThatIsMissingAndOneThatIsUnknownAreNamed) {
  Robot base;
  base.drives[2].node_id = 42;
  const Group group = scanned(base, {});
  EXPECT_EQ(of(group, "answer").found, "3 of four");
  EXPECT_EQ(of(group, "missing").state, State::kFault);
  EXPECT_EQ(of(group, "missing").found.find("node 3 (rear left)"), 0U);
  EXPECT_EQ(of(group, "unknown").state, State::kWarning);
  EXPECT_EQ(of(group, "unknown").found.find("node 42"), 0U);
}

TEST(DriveChecks, AnotherMakeThanTheRobotFilesIsAFault) {
  Robot robot;
  robot.drives[0].vendor_id = 0x12345678;
  const Group group = scanned({}, robot);
  EXPECT_EQ(of(group, "differs").state, State::kFault);
  EXPECT_NE(of(group, "differs").found.find("12345678h"), std::string::npos);
}

TEST(DriveChecks, AnEmptyBusIsOneFaultAndNotFour) {
  Robot robot;
  for (std::uint8_t i = 0; i < kWheels; ++i) {
    robot.drives[i].node_id = static_cast<std::uint8_t>(50 + i);
  }
  const Group group = scanned({}, robot);
  EXPECT_EQ(of(group, "answer").state, State::kFault);
  EXPECT_EQ(of(group, "answer").found, "none of the four: node-ids 50, 51, 52, 53");
  EXPECT_EQ(std::ranges::count(group.findings, State::kFault, &Finding::state), 1);
}

TEST(DriveChecks, BesideAControllerItListensAndSaysSo) {
  const hal::CanFrame heartbeat{.id = drivers::cob_id::heartbeat(127), .size = 1, .data = {0x05}};
  const Group group = scanned({}, {}, heartbeat);
  EXPECT_EQ(of(group, "controller").found,
            "one is running (heard a heartbeat of node 127): nobody was asked anything, only listened to");
}

}  // namespace
}  // namespace ivo::firmware::doctor
