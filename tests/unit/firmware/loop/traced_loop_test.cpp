// What a loop says of its cycles, and that saying it changes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "firmware/record/traced_bus.hpp"
#include "tests/support/heap_trap.hpp"
#include "tests/support/search_rig.hpp"
#include "tests/support/ticking_clock.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ns;
using std::chrono_literals::operator""s;

/// A search whose loop is traced, frames too.
class TracedSearch {
 public:
  TracedSearch()
      : rig_({.between = [this](hal::CanBus& bus) -> hal::CanBus& {
                bus_ = std::make_unique<TracedBus>(bus, tracer_);
                return *bus_;
              },
              .tracer = &tracer_,
              .trace_stopwatch = &stopwatch_}) {}

  test::SearchRig& rig() { return rig_; }
  [[nodiscard]] std::uint64_t lost() const { return ring_->lost(); }
  std::vector<TraceEvent> events() {
    std::vector<TraceEvent> all;
    for (TraceEvent event; ring_->pop(event);) {
      all.push_back(event);
    }
    return all;
  }

 private:
  test::TickingClock stopwatch_{1ns};
  std::unique_ptr<TraceRing> ring_ = std::make_unique<TraceRing>();
  Tracer tracer_{stopwatch_, ring_.get()};
  std::unique_ptr<TracedBus> bus_;
  test::SearchRig rig_;
};

int count(const std::vector<TraceEvent>& events, TraceKind kind) {
  return static_cast<int>(
      std::count_if(events.begin(), events.end(), [&](const TraceEvent& event) { return event.kind == kind; }));
}

TEST(TracedLoop, EachCycleHasItsTenPhasesInOrderAndOneEnd) {
  TracedSearch search;
  search.rig().run(1s);
  const auto events = search.events();
  EXPECT_EQ(search.lost(), 0U);
  const int cycles = static_cast<int>(search.rig().loop().status().counters.cycles);
  EXPECT_EQ(count(events, TraceKind::kCycleBegan), cycles);
  EXPECT_EQ(count(events, TraceKind::kCycleEnded), cycles);
  EXPECT_EQ(count(events, TraceKind::kPhase), cycles * static_cast<int>(kPhases));
  std::size_t phase = 0;
  for (const TraceEvent& event : events) {
    if (event.kind == TraceKind::kPhase) {
      EXPECT_EQ(event.code, phase++ % kPhases);
    }
  }
}

TEST(TracedLoop, SlicesOfThePlannerAddUpToTheWorkOfTheirCycles) {
  TracedSearch search;
  ASSERT_TRUE(search.rig().run_until(Mode::kAwaitingConsent));
  std::int64_t sliced = 0;
  std::int64_t moves = 0;
  std::int64_t units = 0;
  std::int64_t moved = 0;
  for (const TraceEvent& event : search.events()) {
    if (event.kind == TraceKind::kSlice) {
      EXPECT_NE(event.code, static_cast<std::uint8_t>(planner::SliceKind::kNone));
      sliced += event.get<TracedWork>().units;
      moves += event.get<TracedWork>().moves;
    } else if (event.kind == TraceKind::kCycleEnded) {
      units += event.get<TracedWork>().units;
      moved += event.get<TracedWork>().moves;
    }
  }
  EXPECT_GT(units, 0);
  EXPECT_EQ(sliced, units);
  EXPECT_GT(moves, 0);
  EXPECT_EQ(moves, moved);
}

TEST(TracedLoop, FramesAreAsManyAsTheBusCounts) {
  TracedSearch search;
  search.rig().run(1s);
  const auto events = search.events();
  const hal::BusCounters& bus = search.rig().loop().status().counters.bus;
  EXPECT_EQ(count(events, TraceKind::kFrameOut), static_cast<int>(bus.sent));
  EXPECT_EQ(count(events, TraceKind::kFrameIn), static_cast<int>(bus.received));
}

TEST(TracedLoop, ModesAreToldFromTheFirstOn) {
  TracedSearch search;
  ASSERT_TRUE(search.rig().start_search());
  std::vector<Mode> modes;
  for (const TraceEvent& event : search.events()) {
    if (event.kind == TraceKind::kMode) {
      modes.push_back(static_cast<Mode>(event.code));
    }
  }
  ASSERT_FALSE(modes.empty());
  EXPECT_EQ(modes.front(), Mode::kPlanning);
  EXPECT_EQ(modes.back(), Mode::kSearching);
}

TEST(TracedLoop, ASearchIsTheSameAsWithout) {
  test::SearchRig plain({});
  ASSERT_TRUE(plain.start_search());
  ASSERT_TRUE(plain.run_until(Mode::kDone));
  const auto expected = plain.events();
  TracedSearch traced;
  ASSERT_TRUE(traced.rig().start_search());
  ASSERT_TRUE(traced.rig().run_until(Mode::kDone));
  const auto events = traced.rig().events();
  EXPECT_GT(traced.lost(), 0U) << "a full ring does not hold it up either";
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].at, expected[i].at);
    EXPECT_EQ(events[i].kind, expected[i].kind);
    EXPECT_EQ(events[i].x, expected[i].x);
    EXPECT_EQ(events[i].y, expected[i].y);
  }
}

TEST(TracedLoop, TracingTakesNoMemory) {
  TracedSearch search;
  bool started = false;
  {
    const test::NoHeap no_heap;
    started = search.rig().start_search();
    search.rig().run(1s);
  }
  EXPECT_TRUE(started);
}

}  // namespace
}  // namespace ivo::firmware
