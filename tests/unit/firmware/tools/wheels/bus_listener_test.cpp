#include "firmware/tools/wheels/bus_listener.hpp"

#include <numbers>
#include <string>
#include <vector>

#include "firmware/tools/wheels/frame_bits.hpp"
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
  EXPECT_EQ(count("rear left: emergency 7300h: sensor: encoder or its cable (error register 01h)\n"), 1) << text;
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

TEST(FrameBits, AreWhatIsKnownOfFramesWithoutAndWithStuffing) {
  // Bounds for every size: 47 + 8 n bits without stuffing, floor((34 + 8 n - 1) / 4) more at worst.
  std::uint32_t state = 7;
  for (int i = 0; i < 20'000; ++i) {
    state = state * 1664525U + 1013904223U;
    hal::CanFrame frame;
    frame.id = static_cast<std::uint16_t>(state >> 8 & 0x7FF);
    frame.size = static_cast<std::uint8_t>((state >> 20) % 9);
    for (std::uint8_t& byte : frame.data) {
      state = state * 1664525U + 1013904223U;
      byte = static_cast<std::uint8_t>(state >> 24);
    }
    const int plain = 47 + 8 * frame.size;
    EXPECT_GE(frame_bits(frame), plain);
    EXPECT_LE(frame_bits(frame), plain + (34 + 8 * frame.size - 1) / 4);
  }
  // By hand: id 0, no data. From the start bit to the end of the CRC all 34 bits are zero: a stuff bit after each five.
  EXPECT_EQ(frame_bits({.id = 0, .size = 0, .data = {}}), 47 + 6);
  // 555h has no two equal bits in a row after the start bit's 0 then 1...: nothing to stuff before the length.
  EXPECT_LT(frame_bits({.id = 0x555, .size = 0, .data = {}}), 47 + 3);
}

TEST(StateWords, NameEveryErrorCode) {
  for (int code = 0; code <= 0xFFFF; ++code) {
    EXPECT_FALSE(error_code_text(static_cast<std::uint16_t>(code)).empty());
  }
  EXPECT_EQ(error_code_text(0x3220), "3220h: DC link under-voltage: supply, fuse or emergency stop");
  EXPECT_EQ(error_code_text(0x8130), "8130h: heartbeat lost: the controller's, or node guarding");
  EXPECT_EQ(error_code_text(0xFF42), "FF42h: the maker's own code, see the drive's manual");
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
