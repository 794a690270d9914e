// The group over four bare nodes: what simulated drives do not do, all four at once.
#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/drive_fault_text.hpp"
#include "tests/unit/drivers/bare_node.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;
using std::chrono::milliseconds;

class BareGroup {
 public:
  explicit BareGroup(const Robot& robot_parameters) : robot(robot_parameters), group(narrow, robot) {
    for (const DriveParameters& drive : robot.drives) {
      nodes.emplace_back(drive.node_id);
    }
  }

  GroupState cycle() {
    std::array<hal::ReceivedFrame, 64> frames;
    const std::size_t to_master = bus.port(0).receive(frames, now);
    std::for_each_n(frames.begin(), to_master, [&](const hal::ReceivedFrame& r) { group.on_frame(r); });
    feedback = group.update(now);
    group.write(now, enable, targets);
    const std::size_t to_nodes = bus.port(1).receive(frames, now);
    sent.clear();
    for (std::size_t i = 0; i < to_nodes; ++i) {
      sent.push_back(frames[i].frame);
      for (BareNode& node : nodes) {
        node.on_frame(frames[i].frame, now);
      }
    }
    now += robot.cycle;
    for (BareNode& node : nodes) {
      for (const hal::CanFrame& frame : node.update(now)) {
        bus.port(1).send({&frame, 1}, now);
      }
    }
    return feedback.state;
  }

  bool run_until(GroupState state, Duration time = std::chrono::seconds(30)) {
    for (const Instant end = now + time; now < end;) {
      if (cycle() == state) {
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

  [[nodiscard]] std::vector<std::uint16_t> ids_sent() const {
    std::vector<std::uint16_t> ids;
    for (const hal::CanFrame& frame : sent) {
      if ((frame.id & 0x780) != 0x700) {
        ids.push_back(frame.id);
      }
    }
    return ids;
  }

  Robot robot;
  hal::VirtualBus bus;
  NarrowBus narrow{bus.port(0)};
  DriveGroup group;
  std::vector<BareNode> nodes;
  Instant now{};
  bool enable = false;
  WheelTargets targets;
  GroupFeedback feedback;
  std::vector<hal::CanFrame> sent;  // in the last cycle
};

TEST(BareGroup, IsReadyThoughEverySdoIsAnsweredTwentyMillisecondsLate) {
  BareGroup rig(test_robot());
  for (BareNode& node : rig.nodes) {
    node.delay = milliseconds(20);
  }
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  // All four at once: about eighty transfers of 22 ms.
  EXPECT_LT(rig.now, Instant(milliseconds(2500)));
  for (BareNode& node : rig.nodes) {
    EXPECT_TRUE(node.aborts_received.empty());
  }
}

TEST(BareGroup, IsReadyThoughOneIsSlowOneBootsTwiceOneIsOddAndOneCannotBeMapped) {
  BareGroup rig(test_robot());
  rig.nodes[0].delay = milliseconds(40);
  rig.nodes[1].boot_ups = 2;
  rig.nodes[2].answers = BareNode::Answers::kSegmentsOfAByte;
  rig.nodes[3].fixed_mapping = true;
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  rig.enable = true;
  ASSERT_TRUE(rig.run_until(GroupState::kEnabled)) << describe(rig.feedback.fault);
  rig.targets.radps = {1.0, 1.0, 1.0, 1.0};
  rig.cycle();
  EXPECT_EQ(rig.ids_sent(), (std::vector<std::uint16_t>{0x080, 0x201, 0x202, 0x203, 0x504}));
  rig.cycle();
  for (BareNode& node : rig.nodes) {
    EXPECT_NE(node.target, 0) << int{node.node_id()};
    EXPECT_EQ(node.power.state(), PowerState::kOperationEnabled);
  }
  EXPECT_TRUE(rig.feedback.fresh) << "by TPDO3 of the fourth";
}

TEST(BareGroup, NamesTheOneThatIsSilentAtItsStep) {
  BareGroup rig(test_robot());
  rig.nodes[1].answers_nothing = true;
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.run_until(GroupState::kFault));
  EXPECT_EQ(describe(rig.feedback.fault), "drive 2 (front right) failed at \"device type 1000h\": no SDO answer");
}

TEST(SharedLayout, SendsTargetsEachCycleAndControlwordsWhenTheyChangeOrAreDue) {
  BareGroup rig(shared_robot());
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.enable_all()) << describe(rig.feedback.fault);
  rig.cycle();
  std::array<int, 4> words{};
  constexpr int kCycles = 1000;
  for (int i = 0; i < kCycles; ++i) {
    rig.cycle();
    const std::vector<std::uint16_t> ids = rig.ids_sent();
    EXPECT_EQ(ids.front(), 0x080);
    EXPECT_LE(ids.size(), 4U) << "at most one controlword a cycle";
    EXPECT_EQ(ids[ids.size() - 2], 0x301);
    EXPECT_EQ(ids.back(), 0x303);
    for (const std::uint16_t id : ids) {
      words[(id - 1U) & 3U] += (id & 0x780) == 0x200 ? 1 : 0;
    }
  }
  for (const int count : words) {
    EXPECT_NEAR(count, kCycles * seconds(rig.robot.cycle) / seconds(rates::kControlwordRefresh), 1.0);
  }
}

TEST(SharedLayout, TurnsEachWheelByItsHalf) {
  BareGroup rig(shared_robot());
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.enable_all()) << describe(rig.feedback.fault);
  rig.targets.radps = {1.0, -2.0, 3.0, -4.0};
  rig.cycle();
  rig.cycle();
  for (std::size_t i = 0; i < rig.nodes.size(); ++i) {
    const DriveParameters& drive = rig.robot.drives[i];
    EXPECT_NEAR(rig.nodes[i].target, rig.targets.radps[i] * drive.sign * drive.gear_ratio * drive.velocity_per_radps,
                1.0);
  }
  EXPECT_EQ(rig.feedback.state, GroupState::kEnabled);
}

TEST(SharedLayout, EnablesAllFourInLockstepAndStopsThemTogether) {
  BareGroup rig(shared_robot());
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  rig.enable = true;
  while (rig.cycle() != GroupState::kEnabled) {
    ASSERT_NE(rig.feedback.state, GroupState::kFault);
    for (const BareNode& node : rig.nodes) {
      EXPECT_EQ(node.power.state(), rig.nodes[0].power.state());
      EXPECT_EQ(node.target, 0);
    }
  }
  rig.targets.radps.fill(5.0);
  rig.cycle();
  rig.enable = false;
  rig.cycle();
  EXPECT_EQ(rig.ids_sent(), (std::vector<std::uint16_t>{0x080, 0x201, 0x202, 0x203, 0x204, 0x301, 0x303}));
  rig.cycle();
  for (const BareNode& node : rig.nodes) {
    EXPECT_EQ(node.power.state(), PowerState::kSwitchOnDisabled);
    EXPECT_EQ(node.target, 0);
  }
}

TEST(SharedLayout, StopsAllFourWhenOneFails) {
  BareGroup rig(shared_robot());
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.enable_all()) << describe(rig.feedback.fault);
  rig.targets.radps.fill(5.0);
  rig.cycle();
  rig.cycle();
  const hal::CanFrame emergency = emergency_frame(3, {0x7300, 0x81, {1, 2, 3, 4, 5}});
  rig.bus.port(2).send({&emergency, 1}, rig.now);
  EXPECT_EQ(rig.cycle(), GroupState::kFault);
  rig.cycle();
  for (const BareNode& node : rig.nodes) {
    EXPECT_NE(node.power.state(), PowerState::kOperationEnabled);
    EXPECT_EQ(node.target, 0);
  }
  EXPECT_EQ(rig.group.drive(Wheel::kRearLeft).emergencies().entries()[0].emergency,
            (Emergency{0x7300, 0x81, {1, 2, 3, 4, 5}}));
}

TEST(SharedLayout, SendsAllControlwordsAgainAfterAWriteThatDidNotLeaveWhole) {
  BareGroup rig(shared_robot());
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.enable_all()) << describe(rig.feedback.fault);
  rig.cycle();
  rig.narrow.room = 2;
  rig.cycle();
  rig.narrow.room = 1000;
  rig.cycle();
  EXPECT_EQ(rig.ids_sent(), (std::vector<std::uint16_t>{0x080, 0x201, 0x202, 0x203, 0x204, 0x301, 0x303}));
}

TEST(BareGroup, KeepsAStormOfEmergenciesInAFewEntries) {
  BareGroup rig(test_robot());
  rig.group.open(rig.now);
  ASSERT_TRUE(rig.enable_all()) << describe(rig.feedback.fault);
  for (int i = 0; i < 2000; ++i) {
    const hal::CanFrame emergency = emergency_frame(2, {0x2310, 0x02, {}});
    rig.bus.port(2).send({&emergency, 1}, rig.now);
    rig.cycle();
  }
  const EmcyHistory& history = rig.group.drive(Wheel::kFrontRight).emergencies();
  ASSERT_EQ(history.entries().size(), 1U);
  EXPECT_EQ(history.entries()[0].count, 2000U);
  EXPECT_EQ(rig.feedback.fault.code, 0x2310U);
}

}  // namespace
}  // namespace ivo::drivers
