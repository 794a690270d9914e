#include "firmware/tools/wheels/bus_listener.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "firmware/tools/wheels/state_words.hpp"
#include "firmware/tools/wheels/watch_text.hpp"
#include "tests/unit/firmware/tools/wheels/turner_rig.hpp"

namespace ivo::firmware {
namespace {

using drivers::NmtState;

/// Somebody who listens while the turner drives.
class ListeningRig : public TurnerRig {
 public:
  void listen_on() {
    for (; heard_ < log.size(); ++heard_) {
      listener.on_frame({.frame = log[heard_], .at = clock.now()});
    }
    listener.update(clock.now());
    changes.update(listener, {}, clock.now());
  }
  void go(Duration time, bool key) {
    const Instant begin = clock.now();
    Instant next = begin;
    while (clock.now() - begin < time) {
      const bool press = key && clock.now() >= next;
      next += press ? (next == begin ? 500ms : 30ms) : 0ms;
      cycle({.hold = press});
      listen_on();
    }
  }

  BusListener listener{geared_robot()};
  std::vector<std::string> said;
  wheels::ChangeLog changes{robot, [this](const std::string& text) { said.push_back(text); }};

 private:
  std::size_t heard_ = 0;
};

TEST(BusListener, HearsWhatTheDrivesDoAndAreTold) {
  ListeningRig rig;
  rig.go(1s, false);
  rig.turner.give({.wheel = Wheel::kFrontRight, .radps = 0.5});
  rig.go(4s, true);
  const HeardNode& node = rig.listener.node(Wheel::kFrontRight);
  EXPECT_EQ(node.state, NmtState::kOperational);
  ASSERT_TRUE(node.status.has_value());
  EXPECT_EQ(drivers::cia402::power_state(node.status->statusword), drivers::cia402::PowerState::kOperationEnabled);
  EXPECT_NEAR(node.told_radps.value_or(0.0), 0.5, 0.001);
  EXPECT_NEAR(rig.listener.radps(Wheel::kFrontRight, rig.clock.now()), 0.5, 0.05);
  EXPECT_NEAR(rig.listener.angle_rad(Wheel::kFrontRight) / (2.0 * std::numbers::pi), rig.turns(Wheel::kFrontRight),
              0.01);
  EXPECT_NEAR(rig.listener.traffic().syncs_per_s, 500.0, 5.0);
  EXPECT_NEAR(rig.listener.traffic().load, 0.43, 0.06);
  EXPECT_TRUE(rig.listener.controller_at().has_value());
}

TEST(BusListener, HearsTheTargetsThatTwoWheelsShare) {
  Robot robot = geared_robot();
  robot.pdo_layout = PdoLayout::kShared;
  BusListener listener(robot);
  const double units = TurnMeasure::scale_of(robot.drives[2]).units_per_radps;
  const drivers::TargetPair rear{static_cast<std::int32_t>(std::lround(2.0 * units)), 0};
  const std::uint16_t id = drivers::standard_channels(robot, Wheel::kRearLeft).targets_id;
  listener.on_frame({.frame = drivers::target_pair_frame(id, rear), .at = Instant{}});
  EXPECT_NEAR(listener.node(Wheel::kRearLeft).told_radps.value_or(0.0), 2.0, 0.001);
  EXPECT_EQ(listener.node(Wheel::kRearRight).told_radps, 0.0);
  EXPECT_FALSE(listener.node(Wheel::kFrontLeft).told_radps.has_value()) << "the front pair was told nothing";
  const drivers::TargetPair other{0, rear.first};
  listener.on_frame({.frame = drivers::target_pair_frame(id, other), .at = Instant{}});
  EXPECT_EQ(listener.node(Wheel::kRearLeft).told_radps, 0.0);
  EXPECT_NEAR(std::abs(listener.node(Wheel::kRearRight).told_radps.value_or(0.0)), 2.0, 0.001);
}

TEST(BusListener, TakesNoTargetFromAFrameOfTheOtherLayout) {
  for (const PdoLayout layout : {PdoLayout::kOwn, PdoLayout::kShared}) {
    Robot robot;
    robot.pdo_layout = layout;
    BusListener listener(robot);
    const bool own = layout == PdoLayout::kOwn;
    const hal::CanFrame frame = own ? drivers::target_pair_frame(0x301, {500, 500})
                                    : drivers::command_frame(0x201, {.controlword = 0x0F, .target_velocity = 500});
    listener.on_frame({.frame = frame, .at = Instant{}});
    EXPECT_FALSE(listener.node(Wheel::kFrontLeft).told_radps.has_value()) << own;
  }
}

TEST(BusListener, HearsADriveWhoseMappingsAreFixed) {
  Robot robot = geared_robot();
  BusListener listener(robot);
  const double units = TurnMeasure::scale_of(robot.drives[0]).units_per_radps;
  const auto hear = [&](std::uint16_t id, std::uint8_t size, std::array<std::uint8_t, 8> data) {
    listener.on_frame({.frame = {.id = id, .size = size, .data = data}, .at = Instant{}});
  };
  hear(0x181, 2, {0x37, 0x12});                          // {6041h}
  hear(0x481, 6, {0x37, 0x12, 0x00, 0x00, 0x00, 0x7F});  // {6041h, 606Ch}
  hear(0x381, 6, {0x40, 0x12, 0x10, 0x00, 0x00, 0x00});  // {6041h, 6064h}
  hear(0x481, 6, {0x37, 0x12, 0x00, 0x00, 0x00, 0x7F});
  const HeardNode& node = listener.node(Wheel::kFrontLeft);
  ASSERT_TRUE(node.status.has_value());
  EXPECT_EQ(node.status->statusword, 0x1240);
  EXPECT_EQ(node.status->position, 0x10);
  EXPECT_EQ(node.status_tpdo, 3);
  EXPECT_EQ(listener.angle_rad(Wheel::kFrontLeft), 0.0) << "no travel between two PDOs of different content";
  const auto target = static_cast<std::int32_t>(std::lround(2.0 * units));
  listener.on_frame(
      {.frame = drivers::command_frame(0x501, {.controlword = 0x0F, .target_velocity = target}), .at = Instant{}});
  EXPECT_NEAR(node.told_radps.value_or(0.0), 2.0, 0.001);
}

TEST(BusListener, SaysEachChangeOnceAndInWords) {
  ListeningRig rig;
  rig.go(1s, false);
  rig.drives.drive(Wheel::kRearLeft).script().fault_at = rig.clock.now();
  rig.go(2s, false);
  std::string text;
  for (const std::string& line : rig.said) {
    text += line + "\n";
  }
  const auto count = [&text](const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
      ++found;
    }
    return found;
  };
  EXPECT_EQ(count("rear left: NMT operational\n"), 1) << text;
  EXPECT_EQ(count("rear left: switch on disabled"), 1) << text;
  EXPECT_EQ(count("rear left: fault (statusword"), 1) << text;
  EXPECT_EQ(count("rear left: emergency 7300h, sensor (error register 21h: generic, device profile; vendor "), 1)
      << text;
  EXPECT_EQ(count("front left: emergency"), 0) << text;
  EXPECT_EQ(count("controller: its heartbeat is heard\n"), 1) << text;
}

TEST(BusListener, NoticesWhenADriveOrTheControllerFallsSilent) {
  ListeningRig rig;
  rig.go(1s, false);
  rig.drives.drive(Wheel::kFrontLeft).script().heartbeat_lost_from = rig.clock.now();
  rig.go(500ms, false);
  EXPECT_EQ(std::ranges::count(rig.said, std::string("front left: heartbeat lost")), 1);
}

TEST(BusListener, SurvivesFramesOfAnyKind) {
  BusListener listener{Robot{}};
  std::uint32_t state = 1;
  for (int i = 0; i < 200'000; ++i) {
    state = state * 1664525U + 1013904223U;
    hal::ReceivedFrame received;
    received.frame.id = static_cast<std::uint16_t>(state >> 8 & 0x7FF);
    received.frame.size = static_cast<std::uint8_t>((state >> 20) % 9);
    received.frame.data.fill(static_cast<std::uint8_t>(state >> 24));
    received.at = Instant(Duration(i * 100'000LL));
    listener.on_frame(received);
    listener.update(received.at);
  }
  EXPECT_EQ(listener.frames(), 200'000U);
}

TEST(WatchPicture, HasALineAWheelWhateverIsKnown) {
  const BusListener listener{Robot{}};
  const Robot robot;
  const auto lines = wheels::watch_picture(listener, robot, {}, Instant{});
  ASSERT_EQ(lines.size(), 3U + kWheels);
  EXPECT_NE(lines[3].find("front left"), std::string::npos);
  EXPECT_NE(lines[0].find("controller not heard"), std::string::npos);
}

TEST(StateWords, NameEveryErrorCode) {
  for (int code = 0; code <= 0xFFFF; ++code) {
    EXPECT_FALSE(error_code_text(static_cast<std::uint16_t>(code)).empty());
  }
  EXPECT_EQ(error_code_text(0x3220), "3220h: DC link under-voltage");
  EXPECT_EQ(error_code_text(0x8130), "8130h: heartbeat or node guarding lost");
  EXPECT_EQ(error_code_text(0xFF42), "FF42h: device specific");
  EXPECT_EQ(modes_text(0x3ED), "PP PV TQ HM IP CSP CSV* CST");
  EXPECT_EQ(modes_text(0), "none");
}

TEST(StateWords, KnowAWheelByEveryOfItsNames) {
  for (const char* name : {"rear_left", "rear left", "rl"}) {
    EXPECT_EQ(wheel_called(name), Wheel::kRearLeft);
  }
  EXPECT_FALSE(wheel_called("left").has_value());
  EXPECT_FALSE(wheel_called("").has_value());
}

}  // namespace
}  // namespace ivo::firmware
