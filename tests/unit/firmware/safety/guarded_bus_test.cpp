#include "firmware/safety/guarded_bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>
#include <vector>

namespace ivo::firmware {
namespace {

using hal::CanFrame;
using Frames = std::vector<CanFrame>;

/// Keeps what reaches it; takes `room` frames in all.
class KeepingBus final : public hal::CanBus {
 public:
  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant /*now*/) noexcept override {
    frames[0].frame = {.id = 0x181, .size = 1, .data = {7}};
    return 1;
  }
  std::size_t send(std::span<const CanFrame> frames, Instant /*now*/) noexcept override {
    ++calls;
    const std::size_t taken = std::min(frames.size(), room - sent.size());
    sent.insert(sent.end(), frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(taken));
    last_ = taken;
    return taken;
  }
  std::span<const CanFrame> handed_over() const noexcept override { return std::span(sent).last(last_); }
  hal::BusState state() const noexcept override { return hal::BusState::kPassive; }
  hal::BusCounters counters() const noexcept override { return {.received = 1, .sent = 2, .send_dropped = 3}; }

  Frames sent;
  std::size_t room = 1'000'000;
  int calls = 0;

 private:
  std::size_t last_ = 0;
};

constexpr std::array<std::uint8_t, kWheels> kNodes{1, 2, 5, 9};
constexpr std::uint16_t kMaster = 127;
constexpr std::int32_t kMaxTarget = 10'000;  // 10 rad/s at the wheel, gear 2, 500 units for 1 rad/s

Robot robot() {
  Robot robot;
  robot.base.max_wheel_radps = 10.0;
  robot.master_node_id = kMaster;
  for (std::size_t i = 0; i < kWheels; ++i) {
    robot.drives[i].node_id = kNodes[i];
    robot.drives[i].gear_ratio = 2.0;
    robot.drives[i].velocity_per_radps = 500.0;
    robot.drives[i].sign = i % 2 == 0 ? 1 : -1;
  }
  return robot;
}

CanFrame command(std::uint8_t node, std::uint16_t controlword, std::int32_t target) {
  const auto t = static_cast<std::uint32_t>(target);
  const auto byte = [](std::uint32_t v, int n) { return static_cast<std::uint8_t>(v >> (8 * n)); };
  return {.id = static_cast<std::uint16_t>(0x200 + node),
          .size = 6,
          .data = {byte(controlword, 0), byte(controlword, 1), byte(t, 0), byte(t, 1), byte(t, 2), byte(t, 3)}};
}

CanFrame sdo(std::uint8_t node, std::uint8_t specifier, std::uint16_t index, std::array<std::uint8_t, 4> value = {}) {
  return {.id = static_cast<std::uint16_t>(0x600 + node),
          .size = 8,
          .data = {specifier, static_cast<std::uint8_t>(index & 0xFF), static_cast<std::uint8_t>(index >> 8), 0,
                   value[0], value[1], value[2], value[3]}};
}

CanFrame nmt(std::uint8_t what, std::uint8_t node) { return {.id = 0, .size = 2, .data = {what, node}}; }

class GuardedBusTest : public testing::Test {
 protected:
  /// The reason for which it does not reach the inner bus.
  FrameRefusal refusal_of(const CanFrame& frame) {
    const std::size_t before = inner_.sent.size();
    std::array<std::uint64_t, kFrameRefusals> counts{};
    for (int i = 0; i < kFrameRefusals; ++i) {
      counts[static_cast<std::size_t>(i)] = bus_.refused(static_cast<FrameRefusal>(i));
    }
    const std::size_t taken = bus_.send({&frame, 1}, Instant{});
    EXPECT_EQ(inner_.sent.size() - before, taken);
    if (taken == 1) {
      EXPECT_EQ(inner_.sent.back(), frame);
      return FrameRefusal::kNone;
    }
    for (int i = 1; i < kFrameRefusals; ++i) {
      if (bus_.refused(static_cast<FrameRefusal>(i)) != counts[static_cast<std::size_t>(i)]) {
        EXPECT_EQ(bus_.last_refused_id(), frame.id);
        return static_cast<FrameRefusal>(i);
      }
    }
    ADD_FAILURE() << "lost without a reason";
    return FrameRefusal::kNone;
  }

  KeepingBus inner_;
  GuardedBus bus_{inner_, robot()};
};

TEST_F(GuardedBusTest, LetsExactlyTheListedIdsAndSizesPassOfAllThereAre) {
  // Data of zeros is harmless in every listed frame but NMT, which gets a command.
  int passed = 0;
  for (int permit = 0; permit < 2; ++permit) {
    for (int id = 0; id <= 0xFFFF; ++id) {
      for (int size = 0; size <= 9; ++size) {
        bus_.permit_motion(permit != 0);
        CanFrame frame{.id = static_cast<std::uint16_t>(id), .size = static_cast<std::uint8_t>(size), .data = {}};
        frame.data[0] = id == 0 ? 0x80 : 0;
        const bool of_drive = std::find(kNodes.begin(), kNodes.end(), id & 0x7F) != kNodes.end();
        const bool listed = (id == 0 && size == 2) || (id == 0x80 && size == 0) || (id == 0x77F && size == 1) ||
                            ((id & ~0x7F) == 0x600 && of_drive && size == 8 && permit == 0) ||
                            (id >= 0x200 && id < 0x600 && (id & 0x80) == 0 && of_drive && size == 6);
        ASSERT_EQ(bus_.send({&frame, 1}, Instant{}), listed ? 1U : 0U) << "id " << id << ", size " << size;
        passed += listed ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(passed, 2 * (3 + 4 * 4) + 4);
  EXPECT_EQ(inner_.sent.size(), static_cast<std::size_t>(passed));
}

TEST_F(GuardedBusTest, TellsAWrongSizeFromAnUnknownId) {
  EXPECT_EQ(refusal_of({.id = 0x80, .size = 1}), FrameRefusal::kWrongSize);
  EXPECT_EQ(refusal_of({.id = 0x201, .size = 8}), FrameRefusal::kWrongSize);
  EXPECT_EQ(refusal_of({.id = 0x203, .size = 6}), FrameRefusal::kNotListed);
  EXPECT_EQ(refusal_of({.id = 0x303, .size = 6}), FrameRefusal::kNotListed) << "RPDO2 of no drive of ours";
  EXPECT_EQ(refusal_of({.id = 0x301, .size = 8}), FrameRefusal::kWrongSize) << "RPDO2";
  EXPECT_EQ(refusal_of({.id = 0x281, .size = 6}), FrameRefusal::kNotListed) << "a drive's TPDO2";
  EXPECT_EQ(refusal_of({.id = 0x701, .size = 1}), FrameRefusal::kNotListed)
      << "a drive's heartbeat is not ours to send";
}

TEST_F(GuardedBusTest, LetsOnlyKnownNmtCommandsToOurNodesPass) {
  const std::set<int> commands{0x01, 0x02, 0x80, 0x81, 0x82};
  const std::set<int> nodes{0, 1, 2, 5, 9};
  for (int what = 0; what <= 0xFF; ++what) {
    for (int node = 0; node <= 0xFF; ++node) {
      const bool good = commands.count(what) != 0 && nodes.count(node) != 0;
      ASSERT_EQ(refusal_of(nmt(static_cast<std::uint8_t>(what), static_cast<std::uint8_t>(node))),
                good ? FrameRefusal::kNone : FrameRefusal::kNmtCommand)
          << what << " to " << node;
    }
  }
}

TEST_F(GuardedBusTest, RefusesMotionAtStartUp) {
  for (const std::uint8_t node : kNodes) {
    EXPECT_EQ(refusal_of(command(node, 0x0F, 1)), FrameRefusal::kMotionNotPermitted);
  }
}

TEST_F(GuardedBusTest, NeedsAPermitForEveryControlwordThatEnablesOperation) {
  for (int word = 0; word <= 0xFFFF; ++word) {
    const bool enables = (word & 0x0F) == 0x0F && (word & 0x80) == 0;
    bus_.permit_motion(false);
    ASSERT_EQ(refusal_of(command(1, static_cast<std::uint16_t>(word), 0)),
              enables ? FrameRefusal::kMotionNotPermitted : FrameRefusal::kNone)
        << word;
    bus_.permit_motion(true);
    ASSERT_EQ(refusal_of(command(1, static_cast<std::uint16_t>(word), 0)), FrameRefusal::kNone) << word;
  }
}

TEST_F(GuardedBusTest, NeedsAPermitForEveryTargetWhateverTheControlword) {
  for (const std::uint16_t word : std::initializer_list<std::uint16_t>{0x00, 0x02, 0x06, 0x07, 0x0F, 0x80}) {
    for (const std::int32_t target : {1, -1, 256, -256, 1 << 13, kMaxTarget, -kMaxTarget}) {
      bus_.permit_motion(false);
      EXPECT_EQ(refusal_of(command(5, word, target)), FrameRefusal::kMotionNotPermitted);
      bus_.permit_motion(true);
      EXPECT_EQ(refusal_of(command(5, word, target)), FrameRefusal::kNone);
    }
  }
}

TEST_F(GuardedBusTest, LetsEachPermitMoveEachWheelOnce) {
  bus_.permit_motion(true);
  for (const std::uint8_t node : kNodes) {
    EXPECT_EQ(refusal_of(command(node, 0x0F, 100)), FrameRefusal::kNone);
  }
  for (const std::uint8_t node : kNodes) {
    EXPECT_EQ(refusal_of(command(node, 0x0F, 100)), FrameRefusal::kMotionNotPermitted) << "the permit is not renewed";
  }
  bus_.permit_motion(true);
  EXPECT_EQ(refusal_of(command(kNodes[0], 0x0F, 100)), FrameRefusal::kNone);
}

TEST_F(GuardedBusTest, EndsAnUnusedPermitWhenTheBusIsReadAgain) {
  bus_.permit_motion(true);
  hal::ReceivedFrame frame;
  EXPECT_EQ(bus_.receive({&frame, 1}, Instant{}), 1U);
  EXPECT_EQ(refusal_of(command(1, 0x0F, 0)), FrameRefusal::kMotionNotPermitted);
}

TEST_F(GuardedBusTest, TakesBackAPermit) {
  bus_.permit_motion(true);
  bus_.permit_motion(false);
  EXPECT_EQ(refusal_of(command(1, 0x0F, 0)), FrameRefusal::kMotionNotPermitted);
}

TEST_F(GuardedBusTest, SpendsNoPermitOnWhatMovesNothingOrIsRefused) {
  bus_.permit_motion(true);
  EXPECT_EQ(refusal_of(command(1, 0x06, 0)), FrameRefusal::kNone);
  EXPECT_EQ(refusal_of(command(1, 0x0F, kMaxTarget + 1)), FrameRefusal::kTargetTooHigh);
  EXPECT_EQ(refusal_of(command(1, 0x0F, 5)), FrameRefusal::kNone);
}

TEST_F(GuardedBusTest, AlwaysLetsAStopPass) {
  for (const std::uint16_t word : std::initializer_list<std::uint16_t>{0x00, 0x02, 0x06, 0x07, 0x80}) {
    EXPECT_EQ(refusal_of(command(9, word, 0)), FrameRefusal::kNone);
  }
}

TEST_F(GuardedBusTest, RefusesTargetsBeyondTheWheelsLargestSpeedEvenWithAPermit) {
  for (const std::int32_t target : {kMaxTarget + 1, -kMaxTarget - 1, std::numeric_limits<std::int32_t>::max(),
                                    std::numeric_limits<std::int32_t>::min()}) {
    bus_.permit_motion(true);
    EXPECT_EQ(refusal_of(command(2, 0x0F, target)), FrameRefusal::kTargetTooHigh) << target;
  }
}

TEST_F(GuardedBusTest, RefusesEverySdoWhileMotionIsPermitted) {
  const std::vector<CanFrame> requests{sdo(1, 0x40, 0x6061), sdo(2, 0x2B, 0x6040), sdo(5, 0x23, 0x60FF),
                                       sdo(9, 0x60, 0x0000), sdo(9, 0x80, 0x1008, {0, 0, 4, 5})};
  for (const CanFrame& request : requests) {
    bus_.permit_motion(true);
    EXPECT_EQ(refusal_of(request), FrameRefusal::kSdoInMotion);
    EXPECT_EQ(refusal_of(command(1, 0x0F, 5)), FrameRefusal::kNone);
    EXPECT_EQ(refusal_of(request), FrameRefusal::kSdoInMotion) << "the permit is used, but motion goes on";
    bus_.permit_motion(false);
    EXPECT_EQ(refusal_of(request), FrameRefusal::kNone);
  }
}

TEST_F(GuardedBusTest, RefusesEveryOtherWriteOfTheControlwordBySdo) {
  for (const std::uint8_t specifier :
       std::initializer_list<std::uint8_t>{0x20, 0x21, 0x22, 0x23, 0x27, 0x2B, 0x2F, 0xC0, 0xC2, 0xC6}) {
    EXPECT_EQ(refusal_of(sdo(1, specifier, 0x6040, {6, 0, 0, 0})), FrameRefusal::kMotionBySdo) << int{specifier};
  }
}

TEST_F(GuardedBusTest, LetsTheControlwordBeWrittenBySdoAsTwoBytesOfZeroAndInNoOtherWay) {
  for (int specifier = 0; specifier <= 0xFF; ++specifier) {
    const bool downloads = (specifier & 0xE0) == 0x20 || (specifier & 0xE0) == 0xC0;
    EXPECT_EQ(refusal_of(sdo(1, static_cast<std::uint8_t>(specifier), 0x6040)),
              downloads && specifier != 0x2B ? FrameRefusal::kMotionBySdo : FrameRefusal::kNone)
        << specifier;
  }
  for (std::size_t byte = 0; byte < 4; ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      std::array<std::uint8_t, 4> value{};
      value[byte] = static_cast<std::uint8_t>(1 << bit);
      EXPECT_EQ(refusal_of(sdo(1, 0x2B, 0x6040, value)), FrameRefusal::kMotionBySdo) << byte << ' ' << bit;
    }
  }
  CanFrame elsewhere = sdo(1, 0x2B, 0x6040);
  elsewhere.data[3] = 1;
  EXPECT_EQ(refusal_of(elsewhere), FrameRefusal::kMotionBySdo);
}

TEST_F(GuardedBusTest, RefusesATargetOtherThanZeroBySdo) {
  for (const std::uint8_t specifier : std::initializer_list<std::uint8_t>{0x22, 0x23, 0x27, 0x2B, 0x2F}) {
    EXPECT_EQ(refusal_of(sdo(2, specifier, 0x60FF)), FrameRefusal::kNone) << int{specifier};
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::uint8_t, 4> value{};
      value[i] = 1;
      EXPECT_EQ(refusal_of(sdo(2, specifier, 0x60FF, value)), FrameRefusal::kMotionBySdo) << int{specifier};
    }
  }
}

TEST_F(GuardedBusTest, RefusesATargetInPiecesBySdoBecauseItsValueCannotBeSeen) {
  for (const std::uint8_t specifier : std::initializer_list<std::uint8_t>{0x20, 0x21, 0xC0, 0xC2, 0xC6}) {
    EXPECT_EQ(refusal_of(sdo(2, specifier, 0x60FF)), FrameRefusal::kMotionBySdo) << int{specifier};
  }
}

TEST_F(GuardedBusTest, LetsOtherSdoWorkPass) {
  EXPECT_EQ(refusal_of(sdo(1, 0x40, 0x6040)), FrameRefusal::kNone) << "reading the controlword";
  EXPECT_EQ(refusal_of(sdo(1, 0x40, 0x60FF)), FrameRefusal::kNone);
  EXPECT_EQ(refusal_of(sdo(1, 0x2F, 0x6060, {3, 0, 0, 0})), FrameRefusal::kNone);
  EXPECT_EQ(refusal_of(sdo(1, 0x23, 0x1400, {1, 2, 0, 0x80})), FrameRefusal::kNone);
  EXPECT_EQ(refusal_of(sdo(1, 0x80, 0x6040, {0, 0, 4, 5})), FrameRefusal::kNone) << "aborting a transfer";
}

TEST_F(GuardedBusTest, SendsTheGoodFramesOfASpanInOrderAndNoOthers) {
  const Frames frames{{.id = 0x80},  command(1, 0x0F, 5), nmt(0x01, 0),
                      {.id = 0x7FF}, {.id = 0x100},       command(2, 0x06, 0)};
  EXPECT_EQ(bus_.send(frames, Instant{}), 3U);
  EXPECT_EQ(inner_.sent, (Frames{frames[0], frames[2], frames[5]}));
  EXPECT_EQ(bus_.refused(), 3U);
  EXPECT_EQ(bus_.refused(FrameRefusal::kMotionNotPermitted), 1U);
  EXPECT_EQ(bus_.refused(FrameRefusal::kNotListed), 2U);
  EXPECT_EQ(bus_.last_refused_id(), 0x100);
  EXPECT_EQ(bus_.counters().send_refused, 3U);
}

TEST_F(GuardedBusTest, SendsASpanWithoutRefusalsAtOnce) {
  bus_.permit_motion(true);
  const Frames frames{
      {.id = 0x80}, command(1, 0x0F, 5), command(2, 0x0F, -5), command(5, 0x0F, 5), command(9, 0x0F, -5)};
  EXPECT_EQ(bus_.send(frames, Instant{}), 5U);
  EXPECT_EQ(inner_.calls, 1);
  EXPECT_FALSE(bus_.last_refused_id().has_value());
}

TEST_F(GuardedBusTest, CallsTheInnerBusWithNothingToSayForWhatWaitsThere) {
  EXPECT_EQ(bus_.send({}, Instant{}), 0U);
  EXPECT_EQ(inner_.calls, 1);
  const Frames refused{{.id = 0x7FF}, {.id = 0x100}};
  EXPECT_EQ(bus_.send(refused, Instant{}), 0U);
  EXPECT_EQ(inner_.calls, 2);
  EXPECT_TRUE(inner_.sent.empty());
}

TEST_F(GuardedBusTest, TellsWhatTheInnerBusHandedOver) {
  inner_.room = 2;
  const Frames frames{{.id = 0x80}, {.id = 0x7FF}, command(2, 0x06, 0), command(5, 0x06, 0)};
  EXPECT_EQ(bus_.send(frames, Instant{}), 2U);
  EXPECT_EQ(Frames(bus_.handed_over().begin(), bus_.handed_over().end()), (Frames{frames[0], frames[2]}));
}

TEST_F(GuardedBusTest, LetsNoWheelMoveWhenAnotherOfTheSameSpanMayNot) {
  bus_.permit_motion(true);
  const Frames frames{{.id = 0x80}, command(1, 0x0F, 5), command(2, 0x0F, 1'000'000'000), command(5, 0x02, 0)};
  EXPECT_EQ(bus_.send(frames, Instant{}), 2U);
  EXPECT_EQ(inner_.sent, (Frames{frames[0], frames[3]})) << "what stops passes";
  EXPECT_EQ(bus_.refused(FrameRefusal::kNotWithTheOthers), 1U);
  EXPECT_EQ(bus_.refused(FrameRefusal::kTargetTooHigh), 1U);
}

TEST_F(GuardedBusTest, PassesMoreFramesThanACycleHas) {
  const Frames frames(3 * limits::kFramesPerCycle, CanFrame{.id = 0x80});
  EXPECT_EQ(bus_.send(frames, Instant{}), frames.size());
  EXPECT_EQ(inner_.sent, frames);
}

TEST_F(GuardedBusTest, ReportsWhatTheInnerBusTook) {
  inner_.room = 1;
  const Frames frames{{.id = 0x80}, {.id = 0x7FF}, command(2, 0x06, 0)};
  EXPECT_EQ(bus_.send(frames, Instant{}), 1U);
  EXPECT_EQ(inner_.sent.size(), 1U);
}

TEST_F(GuardedBusTest, ReceivesAndReportsLikeTheInnerBus) {
  std::array<hal::ReceivedFrame, 2> frames{};
  EXPECT_EQ(bus_.receive(frames, Instant{}), 1U);
  EXPECT_EQ(frames[0].frame.id, 0x181);
  EXPECT_EQ(bus_.state(), hal::BusState::kPassive);
  EXPECT_EQ(bus_.counters().send_dropped, 3U);
}

TEST_F(GuardedBusTest, JudgesEveryRpdoThatADriveMayHaveFallenBackToAsStrictly) {
  for (const int base : {0x200, 0x300, 0x400, 0x500}) {
    const auto with_id = [base](CanFrame frame) {
      frame.id = static_cast<std::uint16_t>(base + (frame.id & 0x7F));
      return frame;
    };
    bus_.permit_motion(false);
    EXPECT_EQ(refusal_of(with_id(command(5, 0x0F, 0))), FrameRefusal::kMotionNotPermitted);
    EXPECT_EQ(refusal_of(with_id(command(5, 0x06, 1))), FrameRefusal::kMotionNotPermitted);
    EXPECT_EQ(refusal_of(with_id(command(5, 0x06, 0))), FrameRefusal::kNone);
    bus_.permit_motion(true);
    EXPECT_EQ(refusal_of(with_id(command(5, 0x0F, kMaxTarget + 1))), FrameRefusal::kTargetTooHigh);
    EXPECT_EQ(refusal_of(with_id(command(5, 0x0F, kMaxTarget))), FrameRefusal::kNone);
    EXPECT_EQ(refusal_of(command(5, 0x0F, 1)), FrameRefusal::kMotionNotPermitted) << "one permit for all of them";
  }
}

Robot shared_robot() {
  Robot shared = robot();
  shared.pdo_layout = PdoLayout::kShared;
  return shared;
}

CanFrame targets(std::uint8_t first_node, std::int32_t first, std::int32_t second) {
  CanFrame frame{.id = static_cast<std::uint16_t>(0x300 + first_node), .size = 8, .data = {}};
  for (std::size_t i = 0; i < 4; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(first) >> (8 * i));
    frame.data[4 + i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(second) >> (8 * i));
  }
  return frame;
}

CanFrame controlword(std::uint8_t node, std::uint16_t word) {
  CanFrame frame = command(node, word, 0);
  frame.size = 2;
  return frame;
}

class SharedGuardedBusTest : public testing::Test {
 protected:
  bool passes(const CanFrame& frame) { return bus_.send({&frame, 1}, Instant{}) == 1; }
  /// Refused for this reason, and no other.
  bool refused_for(FrameRefusal reason, const CanFrame& frame) {
    const std::uint64_t before = bus_.refused(reason);
    return !passes(frame) && bus_.refused(reason) == before + 1;
  }
  KeepingBus inner_;
  GuardedBus bus_{inner_, shared_robot()};
};

TEST_F(SharedGuardedBusTest, LetsExactlyTheListedIdsAndSizesPassOfAllThereAre) {
  for (int permit = 0; permit < 2; ++permit) {
    for (int id = 0; id <= 0x7FF; ++id) {
      for (int size = 0; size <= 9; ++size) {
        bus_.permit_motion(permit != 0);
        CanFrame frame{.id = static_cast<std::uint16_t>(id), .size = static_cast<std::uint8_t>(size), .data = {}};
        frame.data[0] = id == 0 ? 0x80 : 0;
        const bool of_drive = std::find(kNodes.begin(), kNodes.end(), id & 0x7F) != kNodes.end();
        const bool listed = (id == 0 && size == 2) || (id == 0x80 && size == 0) || (id == 0x77F && size == 1) ||
                            ((id & ~0x7F) == 0x600 && of_drive && size == 8 && permit == 0) ||
                            ((id & ~0x7F) == 0x200 && of_drive && size == 2) ||
                            ((id == 0x301 || id == 0x305) && size == 8);
        ASSERT_EQ(passes(frame), listed) << "id " << id << ", size " << size;
      }
    }
  }
}

TEST_F(SharedGuardedBusTest, JudgesTheTargetsOfBothDrivesInAFrame) {
  for (const std::int32_t too_high : {kMaxTarget + 1, -kMaxTarget - 1, std::numeric_limits<std::int32_t>::min()}) {
    bus_.permit_motion(true);
    EXPECT_TRUE(refused_for(FrameRefusal::kTargetTooHigh, targets(1, too_high, 0)));
    EXPECT_TRUE(refused_for(FrameRefusal::kTargetTooHigh, targets(1, 0, too_high)));
    EXPECT_TRUE(refused_for(FrameRefusal::kTargetTooHigh, targets(5, 0, too_high)));
  }
  bus_.permit_motion(true);
  EXPECT_TRUE(passes(targets(1, kMaxTarget, -kMaxTarget)));
}

TEST_F(SharedGuardedBusTest, KnowsTheLargestSpeedOfEachHalf) {
  Robot uneven = shared_robot();
  uneven.drives[3].velocity_per_radps = 50.0;
  const FrameRules rules(uneven);
  EXPECT_EQ(rules.judge(targets(5, 10'000, 1'000), true), FrameRefusal::kNone);
  EXPECT_EQ(rules.judge(targets(5, 1'000, 1'001), true), FrameRefusal::kTargetTooHigh);
}

TEST_F(SharedGuardedBusTest, NeedsAPermitForATargetInEitherHalf) {
  EXPECT_TRUE(refused_for(FrameRefusal::kMotionNotPermitted, targets(1, 1, 0)));
  EXPECT_TRUE(refused_for(FrameRefusal::kMotionNotPermitted, targets(1, 0, -1)));
  EXPECT_TRUE(passes(targets(1, 0, 0)));
  bus_.permit_motion(true);
  EXPECT_TRUE(passes(targets(1, 1, 0)));
  EXPECT_TRUE(refused_for(FrameRefusal::kMotionNotPermitted, targets(1, 1, 0))) << "used";
  EXPECT_TRUE(passes(targets(1, 0, 2))) << "the other half's is left";
  EXPECT_TRUE(passes(targets(5, 1, 1)));
}

TEST_F(SharedGuardedBusTest, NeedsAPermitToEnableAndKeepsItApartFromTheTargets) {
  EXPECT_TRUE(refused_for(FrameRefusal::kMotionNotPermitted, controlword(2, 0x0F)));
  EXPECT_TRUE(passes(controlword(2, 0x07)));
  bus_.permit_motion(true);
  for (const std::uint8_t node : kNodes) {
    EXPECT_TRUE(passes(controlword(node, 0x0F)));
  }
  EXPECT_TRUE(passes(targets(1, 5, 5)));
  EXPECT_TRUE(passes(targets(5, 5, 5)));
  EXPECT_TRUE(refused_for(FrameRefusal::kMotionNotPermitted, controlword(2, 0x0F))) << "used";
}

TEST_F(SharedGuardedBusTest, AlwaysLetsAStopPass) {
  for (const std::uint16_t word : std::initializer_list<std::uint16_t>{0x00, 0x02, 0x06, 0x07, 0x80}) {
    EXPECT_TRUE(passes(controlword(9, word)));
  }
  EXPECT_TRUE(passes(targets(5, 0, 0)));
}

TEST_F(SharedGuardedBusTest, RefusesTheCommandsOfTheOtherLayout) {
  bus_.permit_motion(true);
  EXPECT_TRUE(refused_for(FrameRefusal::kWrongSize, command(1, 0x06, 0)));
  EXPECT_TRUE(refused_for(FrameRefusal::kNotListed, targets(2, 0, 0))) << "the second of a pair has no id of its own";
}

TEST(FrameRules, ListNoNodeIdThatCanNotBe) {
  Robot broken = robot();
  broken.drives[0].node_id = 0;
  broken.drives[1].node_id = 128;
  broken.master_node_id = 0;
  const FrameRules rules(broken);
  EXPECT_EQ(rules.judge({.id = 0x200, .size = 6}, true), FrameRefusal::kNotListed);
  EXPECT_EQ(rules.judge({.id = 0x280, .size = 6}, true), FrameRefusal::kNotListed);
  EXPECT_EQ(rules.judge({.id = 0x700, .size = 1}, true), FrameRefusal::kNotListed);
  EXPECT_EQ(rules.judge(nmt(0x01, 128), true), FrameRefusal::kNmtCommand);
}

TEST(FrameRules, AllowNoTargetForADriveWhoseScaleIsNotANumber) {
  Robot broken = robot();
  broken.drives[0].velocity_per_radps = std::nan("");
  const FrameRules rules(broken);
  EXPECT_EQ(rules.judge(command(kNodes[0], 0x0F, 1), true), FrameRefusal::kTargetTooHigh);
  EXPECT_EQ(rules.judge(command(kNodes[0], 0x0F, 0), true), FrameRefusal::kNone);
}

TEST(FrameRules, AllowTheRoundedUpTargetOfTheLargestSpeed) {
  Robot uneven = robot();
  uneven.drives[0].velocity_per_radps = 500.03;  // 10000.6 units at the largest speed
  const FrameRules rules(uneven);
  EXPECT_EQ(rules.judge(command(kNodes[0], 0x0F, 10'001), true), FrameRefusal::kNone);
  EXPECT_EQ(rules.judge(command(kNodes[0], 0x0F, 10'002), true), FrameRefusal::kTargetTooHigh);
}

TEST(FrameRules, NameEveryReasonDifferently) {
  std::set<std::string_view> names;
  for (int i = 0; i < kFrameRefusals; ++i) {
    names.insert(name_of(static_cast<FrameRefusal>(i)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kFrameRefusals));
}

}  // namespace
}  // namespace ivo::firmware
