#include "firmware/record/tracer.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "hal/sim/manual_clock.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ns;
using std::chrono_literals::operator""us;
using std::chrono_literals::operator""s;

class MarkedCycle final : public hal::CycleMarker {
 public:
  void begin_cycle() noexcept override { marks += "("; }
  void end_phase(std::size_t phase) noexcept override { marks += std::to_string(phase); }
  void end_cycle() noexcept override { marks += ")"; }
  std::string marks;
};

class TracerTest : public testing::Test {
 protected:
  std::vector<TraceEvent> events() const {
    std::vector<TraceEvent> all;
    for (TraceEvent event; ring_->pop(event);) {
      all.push_back(event);
    }
    return all;
  }
  hal::ManualClock stopwatch_;
  std::unique_ptr<TraceRing> ring_ = std::make_unique<TraceRing>();
};

TEST_F(TracerTest, WithoutARingNothingIsTraced) {
  Tracer tracer;
  EXPECT_FALSE(tracer.on());
  tracer.cycle_began(Instant(1us), Instant(2us), 3us, 0);
  tracer.phase(0, Instant(2us), Instant(3us));
  EXPECT_EQ(tracer.now(), Instant{});
  tracer.slice(1, tracer.now(), 1, 1);
  tracer.pose(0, {});
  tracer.cycle_ended();
}

TEST_F(TracerTest, ACycleHasItsTimesItsPhasesAndItsWork) {
  Tracer tracer(stopwatch_, ring_.get());
  EXPECT_TRUE(tracer.on());
  tracer.cycle_began(Instant(10us), Instant(100us), 7us, 2);
  tracer.phase(3, Instant(100us), Instant(104us));
  stopwatch_.sleep_until(Instant(109us));
  tracer.slice(5, Instant(105us), 1000, 12);
  tracer.slice(5, Instant(109us), 500, 3);
  tracer.phase(4, Instant(104us), Instant(110us));
  tracer.cycle_ended();
  const auto all = events();
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(all[0].kind, TraceKind::kCycleBegan);
  EXPECT_EQ(all[0].at, Instant(100us));
  EXPECT_EQ(all[0].get<TracedCycle>().loop_ns, 10'000);
  EXPECT_EQ(all[0].get<TracedCycle>().latency_ns, 7000);
  EXPECT_EQ(all[0].get<TracedCycle>().skipped, 2);
  EXPECT_EQ(all[1].kind, TraceKind::kPhase);
  EXPECT_EQ(all[1].code, 3);
  EXPECT_EQ(all[1].lasted_ns, 4000U);
  EXPECT_EQ(all[2].kind, TraceKind::kSlice);
  EXPECT_EQ(all[2].code, 5);
  EXPECT_EQ(all[2].get<TracedWork>().units, 1000);
  EXPECT_EQ(all[2].get<TracedWork>().moves, 12);
  EXPECT_EQ(all[2].lasted_ns, 4000U);
  EXPECT_EQ(all[5].kind, TraceKind::kCycleEnded);
  EXPECT_EQ(all[5].at, Instant(100us));
  EXPECT_EQ(all[5].lasted_ns, 10'000U);
  EXPECT_EQ(all[5].get<TracedWork>().units, 1500);
  EXPECT_EQ(all[5].get<TracedWork>().moves, 15);
}

TEST_F(TracerTest, WhatHappensIsStampedWithTheLastReadingOfTheStopwatch) {
  Tracer tracer(stopwatch_, ring_.get());
  tracer.cycle_began(Instant(10us), Instant(100us), 0us, 0);
  tracer.mode(4);
  tracer.phase(0, Instant(100us), Instant(104us));
  tracer.fault(9, 2, {.node_id = 3, .code = 0x7500});
  const auto all = events();
  EXPECT_EQ(all[1].at, Instant(100us));
  EXPECT_EQ(all[1].code, 4);
  EXPECT_EQ(all[3].at, Instant(104us));
  EXPECT_EQ(all[3].code, 9);
  EXPECT_EQ(all[3].id, 2);
  EXPECT_EQ(all[3].get<TracedFault>().node_id, 3);
  EXPECT_EQ(all[3].get<TracedFault>().code, 0x7500);
}

TEST_F(TracerTest, FramesKeepTheirDataAndHowLongTheyWaited) {
  Tracer tracer(stopwatch_, ring_.get());
  const hal::CanFrame frame{.id = 0x181, .size = 3, .data = {1, 2, 3}};
  const std::array<hal::ReceivedFrame, 1> received{{{.frame = frame, .at = Instant(8us)}}};
  tracer.frames_in(received, Instant(10us));
  tracer.frames_out(std::span(&frame, 1));
  const auto all = events();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].kind, TraceKind::kFrameIn);
  EXPECT_EQ(all[0].lasted_ns, 2000U);
  EXPECT_EQ(all[0].id, 0x181);
  EXPECT_EQ(all[0].code, 3);
  EXPECT_EQ(all[0].get<TracedFrame>().data, frame.data);
  EXPECT_EQ(all[1].kind, TraceKind::kFrameOut);
}

TEST_F(TracerTest, PosesCommandsAndWheelsKeepTheirNumbers) {
  Tracer tracer(stopwatch_, ring_.get());
  tracer.pose(1, {1.5, -2.5, 0.25});
  tracer.command({0.5, 0.25, -1.0});
  const std::array<double, 4> told{1.0, 2.0, 3.0, 4.0};
  const std::array<double, 4> angles{5.0, 6.0, 7.0, 8.0};
  tracer.wheels(told, angles);
  const auto all = events();
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].id, 1);
  EXPECT_EQ(all[0].get<TracedPose>().y_m, -2.5);
  EXPECT_EQ(all[1].get<TracedTwist>().wz_radps, -1.0);
  EXPECT_EQ(all[2].get<TracedWheels>().wheels[3], 4.0F);
  EXPECT_EQ(all[3].get<TracedWheels>().wheels[0], 5.0F);
}

TEST_F(TracerTest, TimesThatDoNotFitSayTheLongestThatDoesAndNoneIsNegative) {
  Tracer tracer(stopwatch_, ring_.get());
  tracer.phase(0, Instant(0ns), Instant(10s));
  tracer.phase(0, Instant(10s), Instant(9s));
  const auto all = events();
  EXPECT_EQ(all[0].lasted_ns, 0xFFFFFFFFU);
  EXPECT_EQ(all[1].lasted_ns, 0U);
}

TEST_F(TracerTest, WhatTheRingCannotHoldIsCounted) {
  Tracer tracer(stopwatch_, ring_.get());
  for (std::size_t i = 0; i < kTracedEvents + 3; ++i) {
    tracer.mode(0);
  }
  EXPECT_EQ(ring_->lost(), 3U);
}

TEST_F(TracerTest, AMarkerHearsEveryPhaseWithOrWithoutARing) {
  MarkedCycle marker;
  Tracer tracer(stopwatch_, nullptr, &marker);
  EXPECT_TRUE(tracer.on());
  tracer.cycle_began(Instant{}, Instant{}, 0us, 0);
  tracer.phase(0, Instant{}, Instant{});
  tracer.phase(1, Instant{}, Instant{});
  tracer.cycle_ended();
  EXPECT_EQ(marker.marks, "(01)");
}

}  // namespace
}  // namespace ivo::firmware
