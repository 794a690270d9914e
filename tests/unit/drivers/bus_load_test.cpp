#include "drivers/canopen/bus_load.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "config/rates.hpp"
#include "drivers/canopen/frame_bits.hpp"
#include "drivers/canopen/sync.hpp"

namespace ivo::drivers {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""us;

constexpr std::uint32_t kMbit = 1'000'000;

struct Row {
  int commands;
  std::uint8_t command_bytes;
  std::uint8_t status_bytes;
  bool second_status;  // 2 bytes
};

BusLoad percent(const Row& row, Duration cycle) {
  std::vector<PeriodicFrame> frames{{0x080, 0, cycle}};
  for (std::uint16_t i = 1; i <= row.commands; ++i) {
    frames.push_back({static_cast<std::uint16_t>(0x200 + i), row.command_bytes, cycle});
  }
  for (std::uint16_t i = 1; i <= 4; ++i) {
    frames.push_back({static_cast<std::uint16_t>(0x180 + i), row.status_bytes, cycle});
    if (row.second_status) {
      frames.push_back({static_cast<std::uint16_t>(0x280 + i), 2, cycle});
    }
  }
  const BusLoad load = load_of(frames, kMbit);
  return {100 * load.unstuffed, 100 * load.worst};
}

void expect(const Row& row, Duration cycle, double unstuffed, double worst) {
  const BusLoad load = percent(row, cycle);
  EXPECT_NEAR(load.unstuffed, unstuffed, 0.05 + 1e-9);
  EXPECT_NEAR(load.worst, worst, 0.05 + 1e-9);
}

constexpr Row kOwnSixBytes{4, 6, 6, false};
constexpr Row kOwnEightBytes{4, 6, 8, false};
constexpr Row kSecondStatus{4, 6, 8, true};
constexpr Row kSharedCommands{2, 8, 6, false};

TEST(BusLoad, OfTheLayoutsIsThatOfThePublishedBudget) {
  expect(kOwnSixBytes, 1ms, 80.7, 97.5);
  expect(kOwnSixBytes, 2ms, 40.35, 48.75);
  expect(kOwnSixBytes, 4ms, 20.2, 24.4);
  expect(kOwnEightBytes, 1ms, 87.1, 105.5);
  expect(kOwnEightBytes, 2ms, 43.55, 52.75);
  expect(kSecondStatus, 1ms, 112.3, 135.5);
  expect(kSecondStatus, 2ms, 56.15, 67.75);
  expect(kSharedCommands, 1ms, 64.9, 78.5);
  expect(kSharedCommands, 2ms, 32.45, 39.25);
}

TEST(BusLoad, OfFiveHeartbeatsTenTimesASecondIsAThirdOfAPercent) {
  std::vector<PeriodicFrame> frames;
  for (std::uint16_t node = 1; node <= 5; ++node) {
    frames.push_back({static_cast<std::uint16_t>(0x700 + node), 1, 100ms});
  }
  EXPECT_NEAR(100 * load_of(frames, kMbit).worst, 0.325, 1e-9);
}

TEST(BusLoad, OfAnSdoTransferEveryTenMillisecondsIs2Point7Percent) {
  EXPECT_NEAR(100 * load_of(sdo_transfer_every(10ms, 1), kMbit).worst, 2.7, 1e-9);
}

TEST(BusLoad, AtHalfTheBitRateIsTwice) {
  const BusSchedule schedule = schedule_of(Robot{});
  const BusLoad fast = load_of(schedule.span(), kMbit);
  const BusLoad slow = load_of(schedule.span(), kMbit / 2);
  EXPECT_NEAR(slow.worst, 2 * fast.worst, 1e-12);
  EXPECT_NEAR(slow.unstuffed, 2 * fast.unstuffed, 1e-12);
}

TEST(BusLoad, OfTheShippedRobotWithItsHeartbeatsIsBelowHalfAtWorst) {
  const double worst = load_of(schedule_of(Robot{}).span(), kMbit).worst;
  EXPECT_LT(worst, 0.50);
  EXPECT_NEAR(100 * worst, 48.75 + 5 * 65 * 20 / 1e4, 1e-9);
}

TEST(BusLoad, OfTheSharedLayoutCountsControlwordsAsTheyAreRefreshed) {
  Robot robot;
  robot.pdo_layout = PdoLayout::kShared;
  robot.cycle = 1ms;
  const double refreshes = 4 * 75 / (seconds(rates::kControlwordRefresh) * kMbit);
  const double heartbeats = 5 * 65 / (seconds(rates::kDriveHeartbeat) * kMbit);
  EXPECT_NEAR(load_of(schedule_of(robot).span(), kMbit).worst, 0.785 + refreshes + heartbeats, 1e-9);
}

TEST(BusLoad, FitsSaysWhichLayoutGoesWithWhichRate) {
  struct Case {
    PdoLayout layout;
    Duration cycle;
    std::uint32_t bit_rate_bps;
    bool fits;
  };
  for (const Case& c : {Case{PdoLayout::kOwn, 2ms, 1'000'000, true}, Case{PdoLayout::kOwn, 2ms, 800'000, true},
                        Case{PdoLayout::kOwn, 2ms, 500'000, false}, Case{PdoLayout::kOwn, 1ms, 1'000'000, false},
                        Case{PdoLayout::kShared, 1ms, 1'000'000, true}, Case{PdoLayout::kShared, 1ms, 800'000, false},
                        Case{PdoLayout::kShared, 2ms, 500'000, true}, Case{PdoLayout::kShared, 2ms, 250'000, false}}) {
    Robot robot;
    robot.pdo_layout = c.layout;
    robot.cycle = c.cycle;
    robot.bit_rate_bps = c.bit_rate_bps;
    EXPECT_EQ(fits(robot), c.fits) << static_cast<int>(c.layout) << ' ' << c.cycle.count() << ' ' << c.bit_rate_bps;
  }
}

TEST(FrameKind, IsTheFunctionOfTheCobId) {
  const std::vector<std::pair<std::uint16_t, FrameKind>> kinds{
      {0x000, FrameKind::kNmt},       {0x001, FrameKind::kOther}, {0x080, FrameKind::kSync},
      {0x081, FrameKind::kEmcy},      {0x0FF, FrameKind::kEmcy},  {0x100, FrameKind::kOther},
      {0x181, FrameKind::kTpdo},      {0x180, FrameKind::kOther}, {0x201, FrameKind::kRpdo},
      {0x281, FrameKind::kTpdo},      {0x301, FrameKind::kRpdo},  {0x57F, FrameKind::kRpdo},
      {0x581, FrameKind::kSdo},       {0x67F, FrameKind::kSdo},   {0x681, FrameKind::kOther},
      {0x701, FrameKind::kHeartbeat}, {0x7E5, FrameKind::kOther}, {0x77F, FrameKind::kHeartbeat}};
  for (const auto& [id, kind] : kinds) {
    EXPECT_EQ(kind_of(id), kind) << std::hex << id;
  }
}

Instant at(Duration time) { return Instant(time); }

TEST(LoadMeter, OfNothingIsNothing) {
  const LoadMeter::Figures figures = LoadMeter(kMbit).figures();
  EXPECT_EQ(figures.frames, 0U);
  EXPECT_EQ(figures.mean, 0.0);
  EXPECT_EQ(figures.worst_10ms, 0.0);
}

TEST(LoadMeter, CountsEachFramesVeryBits) {
  LoadMeter meter(kMbit);
  for (int i = 0; i <= 1000; ++i) {
    meter.add(at(5ms + i * 2ms), sync_frame());
  }
  const LoadMeter::Figures figures = meter.figures();
  const double bits = bits_on_wire(sync_frame());
  EXPECT_EQ(figures.frames, 1001U);
  EXPECT_EQ(figures.time, 2000ms);
  EXPECT_NEAR(figures.mean, 1001 * bits / 2e6, 1e-12);
  EXPECT_NEAR(figures.worst_10ms, 5 * bits / 1e4, 1e-12);
  EXPECT_NEAR(figures.worst_100ms, 50 * bits / 1e5, 1e-12);
  EXPECT_EQ(figures.kinds[static_cast<std::size_t>(FrameKind::kSync)].frames, 1001U);
  EXPECT_NEAR(figures.kinds[static_cast<std::size_t>(FrameKind::kSync)].load, figures.mean, 1e-12);
}

TEST(LoadMeter, FindsTheBurstWhereverItIs) {
  for (const Duration when : {0ms, 7ms, 99ms, 100ms, 101ms, 4321ms}) {
    LoadMeter meter(kMbit);
    meter.add(at(0ms), sync_frame());
    for (int i = 0; i < 60; ++i) {
      meter.add(at(when + i * 100us), sync_frame());
    }
    meter.add(at(9000ms), sync_frame());
    const double bits = bits_on_wire(sync_frame());
    const int also = when < 4ms ? 1 : 0;  // the first one is in the same 10 ms
    EXPECT_NEAR(meter.figures().worst_10ms, (60 + also) * bits / 1e4, 1e-12) << when.count();
    EXPECT_NEAR(meter.figures().worst_100ms, (60 + (when < 94ms ? 1 : 0)) * bits / 1e5, 1e-12) << when.count();
  }
}

// Windows moved by a millisecond, summed anew each time.
TEST(LoadMeter, HasTheWorstWindowsOfARandomLog) {
  constexpr unsigned kSeed = 7;
  std::uint32_t random = kSeed;
  LoadMeter meter(kMbit);
  std::vector<std::int64_t> bits_in_ms(3000);
  Instant now{};
  const Instant first = now;
  while (now - first < 2999ms) {
    random = random * 1664525U + 1013904223U;
    const hal::CanFrame frame{.id = static_cast<std::uint16_t>(random >> 21), .size = 8, .data = {}};
    meter.add(now, frame);
    bits_in_ms[static_cast<std::size_t>((now - first) / 1ms)] += bits_on_wire(frame);
    now += (random >> 8 & 0xFF) < 3 ? Duration(137ms) : Duration((random >> 8 & 0x7FF) * 1us);
  }
  for (const auto& [window, found] :
       {std::pair{std::size_t{10}, meter.figures().worst_10ms}, {std::size_t{100}, meter.figures().worst_100ms}}) {
    std::int64_t most = 0;
    for (std::size_t begin = 0; begin < bits_in_ms.size(); ++begin) {
      std::int64_t sum = 0;
      for (std::size_t i = begin; i < std::min(begin + window, bits_in_ms.size()); ++i) {
        sum += bits_in_ms[i];
      }
      most = std::max(most, sum);
    }
    EXPECT_NEAR(found, static_cast<double>(most) / (1e3 * static_cast<double>(window)), 1e-12) << "seed " << kSeed;
  }
}

TEST(LoadMeter, TakesAFrameFromThePastAsOneOfNow) {
  LoadMeter meter(kMbit);
  meter.add(at(50ms), sync_frame());
  meter.add(at(20ms), sync_frame());
  EXPECT_EQ(meter.figures().frames, 2U);
  EXPECT_EQ(meter.figures().time, 0ms);
  EXPECT_NEAR(meter.figures().worst_10ms, 2 * bits_on_wire(sync_frame()) / 1e4, 1e-12);
}

}  // namespace
}  // namespace ivo::drivers
