#include <gtest/gtest.h>

#include <chrono>
#include <memory>

#include "firmware/record/tracer.hpp"
#include "firmware/tools/profile/cycle_profile.hpp"
#include "firmware/tools/profile/histogram_text.hpp"
#include "firmware/tools/profile/profile_text.hpp"
#include "hal/sim/manual_clock.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""us;
using std::chrono_literals::operator""ms;

class ProfileTest : public testing::Test {
 protected:
  /// A cycle of 10 us for each phase, and 300 us of thinking when it plans.
  void cycle(bool plans) {
    const Instant begin = now_;
    tracer_.cycle_began(Instant{}, begin, 3us, plans ? 1 : 0);
    for (std::uint8_t phase = 0; phase < kPhases; ++phase) {
      const bool thinks = plans && phase == static_cast<std::uint8_t>(Phase::kThink);
      if (thinks) {
        stopwatch_.sleep_until(now_ + 200us);
        tracer_.slice(static_cast<std::uint8_t>(planner::SliceKind::kChanges), now_, 1000, 40);
        stopwatch_.sleep_until(now_ + 300us);
        tracer_.slice(static_cast<std::uint8_t>(planner::SliceKind::kPathScore), now_ + 200us, 500, 0);
      }
      const Duration lasts = thinks ? 300us : 10us;
      tracer_.phase(phase, now_, now_ + lasts);
      now_ += lasts;
    }
    tracer_.cycle_ended();
    now_ = begin + 2ms;
    for (TraceEvent event; ring_->pop(event);) {
      profile_.take(event);
    }
  }

  std::unique_ptr<TraceRing> ring_ = std::make_unique<TraceRing>();
  hal::ManualClock stopwatch_;
  Tracer tracer_{stopwatch_, ring_.get()};
  CycleProfile profile_;
  Instant now_{};
};

TEST_F(ProfileTest, CyclesThatPlanAndCyclesThatDoNotAreMeasuredApart) {
  cycle(true);
  cycle(true);
  cycle(false);
  EXPECT_EQ(profile_.planning.cycle.count(), 2U);
  EXPECT_EQ(profile_.planning.cycle.worst(), 390us);
  EXPECT_EQ(profile_.planning.phases[static_cast<std::size_t>(Phase::kThink)].worst(), 300us);
  EXPECT_EQ(profile_.driving.cycle.count(), 1U);
  EXPECT_EQ(profile_.driving.cycle.worst(), 100us);
  EXPECT_EQ(profile_.wake_up.worst(), 3us);
  EXPECT_EQ(profile_.skipped, 2);
}

TEST_F(ProfileTest, StepsOfThePlannerHaveTheirTimeTheirUnitsAndTheirMoves) {
  cycle(true);
  cycle(true);
  const StepFigures& changes = profile_.steps[static_cast<std::size_t>(planner::SliceKind::kChanges)];
  EXPECT_EQ(changes.slices.count(), 2U);
  EXPECT_EQ(changes.slices.total(), 400us);
  EXPECT_EQ(changes.units, 2000);
  EXPECT_EQ(changes.moves, 80);
  EXPECT_EQ(profile_.steps[static_cast<std::size_t>(planner::SliceKind::kPathScore)].units, 1000);
}

TEST_F(ProfileTest, IsTold) {
  cycle(true);
  cycle(false);
  const std::string text = profile_text({.profile = profile_, .period = 2ms, .event_cost_ns = 10.0, .events_lost = 0});
  EXPECT_NE(text.find("  think               300.00   300.00   300.00    300.00   76.9 %"), std::string::npos) << text;
  EXPECT_NE(text.find("  route changes       200.00   200.00   200.00    200.00   66.7 %        1   200.00    200,000"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("133,333 moves a second at the median cost of a unit; in all 40 moves, 1,500 units"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("none lost"), std::string::npos) << text;
  EXPECT_NE(text.find("1 periods skipped"), std::string::npos) << text;
}

TEST(HistogramText, HasALineARangeAndCountsEveryValueOnce) {
  TimeHistogram times;
  for (int i = 0; i < 1000; ++i) {
    times.add(std::chrono::microseconds(100 + i % 50));
  }
  times.add(5ms);
  const std::string text = histogram_text(times);
  EXPECT_NE(text.find("us and more"), std::string::npos) << text;
  std::size_t sum = 0;
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
    const std::string line = text.substr(0, at);
    sum += std::stoul(line.substr(line.rfind(' ') + 1));
  }
  EXPECT_EQ(sum, 1001U) << text;
  EXPECT_EQ(histogram_text(TimeHistogram()), "");
}

TEST(Grouped, SeparatesThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1'234'567), "1,234,567");
}

}  // namespace
}  // namespace ivo::firmware
