#include "firmware/record/recording_bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <vector>

#include "hal/sim/virtual_bus.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;

constexpr hal::CanFrame kSync{.id = 0x080, .size = 0, .data = {}};
constexpr hal::CanFrame kFeedback{.id = 0x181, .size = 6, .data = {0x37, 0x02, 1, 2, 3, 4}};

class FullBus final : public hal::CanBus {
 public:
  std::size_t receive(std::span<hal::ReceivedFrame> /*frames*/, Instant /*now*/) noexcept override { return 0; }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant /*now*/) noexcept override {
    return std::min(frames.size(), room);
  }
  [[nodiscard]] hal::BusState state() const noexcept override { return hal::BusState::kPassive; }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return {.sent = 7}; }
  std::size_t room = 0;
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
