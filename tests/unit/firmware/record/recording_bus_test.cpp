#include "firmware/record/recording_bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <random>
#include <vector>

#include "config/rates.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;

constexpr hal::CanFrame kSync{.id = 0x080, .size = 0, .data = {}};
constexpr hal::CanFrame kCommand{.id = 0x201, .size = 6, .data = {0x0F, 0x00, 1, 2, 3, 4}};
constexpr hal::CanFrame kNewerCommand{.id = 0x201, .size = 6, .data = {0x0F, 0x00, 5, 6, 7, 8}};
constexpr hal::CanFrame kFeedback{.id = 0x181, .size = 6, .data = {0x37, 0x02, 1, 2, 3, 4}};

class FullBus final : public hal::CanBus {
 public:
  std::size_t receive(std::span<hal::ReceivedFrame> /*frames*/, Instant /*now*/) noexcept override { return 0; }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant /*now*/) noexcept override {
    handed_over_ = frames.first(std::min(frames.size(), room));
    return handed_over_.size();
  }
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return handed_over_; }
  [[nodiscard]] hal::BusState state() const noexcept override { return hal::BusState::kPassive; }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return {.sent = 7}; }
  std::size_t room = 0;

 private:
  std::span<const hal::CanFrame> handed_over_;
};

struct Rig {
  hal::VirtualBus bus;
  std::unique_ptr<FrameRing> ring = std::make_unique<FrameRing>();
  RecordingBus recording{bus.port(0), *ring};

  std::vector<RecordedFrame> recorded() const {
    std::vector<RecordedFrame> frames;
    for (RecordedFrame frame; ring->pop(frame);) {
      frames.push_back(frame);
    }
    return frames;
  }
};

TEST(RecordingBus, KeepsWhatIsSentAndReceivedInTheirOrder) {
  Rig rig;
  ASSERT_EQ(rig.recording.send({&kSync, 1}, Instant(2ms)), 1U);
  ASSERT_EQ(rig.bus.port(1).send({&kFeedback, 1}, Instant(3ms)), 1U);
  std::array<hal::ReceivedFrame, 4> frames;
  ASSERT_EQ(rig.recording.receive(frames, Instant(4ms)), 1U);
  ASSERT_EQ(rig.recording.send({&kSync, 1}, Instant(4ms)), 1U);
  const std::vector<RecordedFrame> recorded = rig.recorded();
  ASSERT_EQ(recorded.size(), 3U);
  EXPECT_EQ(recorded[0].frame, kSync);
  EXPECT_EQ(recorded[0].at, Instant(2ms));
  EXPECT_EQ(recorded[1].frame, kFeedback);
  EXPECT_EQ(recorded[1].at, Instant(3ms)) << "when it arrived, not when it was looked at";
  EXPECT_EQ(recorded[2].at, Instant(4ms));
  EXPECT_EQ(frames[0].frame, kFeedback);
}

TEST(RecordingBus, KeepsNothingThatTheInterfaceDidNotTake) {
  FullBus full;
  const auto ring = std::make_unique<FrameRing>();
  RecordingBus recording(full, *ring);
  full.room = 1;
  const std::array<hal::CanFrame, 2> frames{kSync, kFeedback};
  EXPECT_EQ(recording.send(frames, Instant{}), 1U);
  RecordedFrame kept;
  ASSERT_TRUE(ring->pop(kept));
  EXPECT_EQ(kept.frame, kSync);
  EXPECT_FALSE(ring->pop(kept));
}

TEST(RecordingBus, KeepsAFrameThatWaitedWhenItLeaves) {
  Rig rig;
  rig.bus.set_room(0, 1);
  const std::array<hal::CanFrame, 2> frames{kSync, kCommand};
  EXPECT_EQ(rig.recording.send(frames, Instant(2ms)), 1U);
  rig.bus.set_room(0, 10);
  EXPECT_EQ(rig.recording.send({&kSync, 1}, Instant(4ms)), 1U);
  EXPECT_EQ(rig.recording.send({}, Instant(6ms)), 0U);
  const std::vector<RecordedFrame> recorded = rig.recorded();
  ASSERT_EQ(recorded.size(), 3U);
  EXPECT_EQ(recorded[0].frame, kSync);
  EXPECT_EQ(recorded[1].frame, kSync);
  EXPECT_EQ(recorded[2].frame, kCommand);
  EXPECT_EQ(recorded[2].at, Instant(4ms)) << "when it left, not when it was given";
}

TEST(RecordingBus, KeepsNothingThatWaitedInVain) {
  Rig rig;
  rig.bus.set_room(0, 0);
  EXPECT_EQ(rig.recording.send({&kCommand, 1}, Instant(2ms)), 0U);
  EXPECT_EQ(rig.recording.send({&kNewerCommand, 1}, Instant(4ms)), 0U) << "replaced";
  rig.bus.set_room(0, 10);
  EXPECT_EQ(rig.recording.send({}, Instant(4ms) + rates::kTransmitAge + 1ms), 0U) << "too old";
  EXPECT_TRUE(rig.recorded().empty());
  EXPECT_EQ(rig.bus.port(0).counters().send_replaced, 1U);
  EXPECT_EQ(rig.bus.port(0).counters().send_dropped, 1U);

  EXPECT_EQ(rig.recording.send({&kCommand, 1}, Instant(100ms)), 1U);
  rig.bus.set_state(0, hal::BusState::kDown);
  EXPECT_EQ(rig.recording.send({&kNewerCommand, 1}, Instant(102ms)), 0U) << "the interface is down";
  const std::vector<RecordedFrame> recorded = rig.recorded();
  ASSERT_EQ(recorded.size(), 1U);
  EXPECT_EQ(recorded[0].frame, kCommand);
}

// Whatever the interface takes, the record is what another node of the bus hears, frame by frame.
TEST(RecordingBus, HoldsWhatAnotherNodeHearsHoweverMuchTheInterfaceTakes) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    Rig rig;
    std::mt19937 random(seed);
    std::vector<hal::CanFrame> heard;
    for (int cycle = 0; cycle < 300; ++cycle) {
      const Instant now(cycle * 2ms);
      rig.bus.set_room(0, random() % 6);
      std::vector<hal::CanFrame> frames(random() % 6);
      for (hal::CanFrame& frame : frames) {
        frame = {.id = static_cast<std::uint16_t>(0x200 + random() % 8), .size = 1, .data = {0}};
        frame.data[0] = static_cast<std::uint8_t>(random());
      }
      (void)rig.recording.send(frames, now);
      std::array<hal::ReceivedFrame, 64> arrived;
      const std::size_t count = rig.bus.port(1).receive(arrived, now);
      for (std::size_t i = 0; i < count; ++i) {
        heard.push_back(arrived[i].frame);
      }
    }
    std::vector<hal::CanFrame> recorded;
    for (const RecordedFrame& frame : rig.recorded()) {
      recorded.push_back(frame.frame);
    }
    EXPECT_EQ(recorded, heard) << "seed " << seed;
    EXPECT_GT(rig.bus.port(0).counters().send_replaced, 0U) << "seed " << seed;
  }
}

TEST(RecordingBus, IsTheInnerBusInAllElse) {
  FullBus full;
  const auto ring = std::make_unique<FrameRing>();
  const RecordingBus recording(full, *ring);
  EXPECT_EQ(recording.state(), hal::BusState::kPassive);
  EXPECT_EQ(recording.counters().sent, 7U);
}

TEST(RecordingBus, CountsWhatTheRingCannotHoldAndPassesItOnAllTheSame) {
  Rig rig;
  for (std::size_t i = 0; i < kRecordedFrames + 3; ++i) {
    ASSERT_EQ(rig.recording.send({&kSync, 1}, Instant{}), 1U);
  }
  EXPECT_EQ(rig.ring->lost(), 3U);
  EXPECT_EQ(rig.bus.port(0).counters().sent, kRecordedFrames + 3U);
}

}  // namespace
}  // namespace ivo::firmware
