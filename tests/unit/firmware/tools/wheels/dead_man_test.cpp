#include "firmware/tools/wheels/dead_man.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;

/// Keys at these times, cycles of 2 ms; returns the cycles' times in which the key counted as held.
std::vector<Duration> held_at(const std::vector<Duration>& keys, Duration until) {
  DeadMan dead_man;
  std::vector<Duration> held;
  std::size_t next = 0;
  for (Duration now = 2ms; now <= until; now += 2ms) {
    dead_man.update(Instant(now));
    bool key = false;
    for (; next < keys.size() && keys[next] <= now; ++next) {
      key = true;
    }
    if (key) {
      dead_man.press(Instant(now));
    }
    if (dead_man.held()) {
      held.push_back(now);
    }
  }
  return held;
}

/// As a keyboard: a press, a pause, repeats.
std::vector<Duration> held_key(Duration from, Duration to, Duration pause = 500ms, Duration every = 30ms) {
  std::vector<Duration> keys{from};
  for (Duration at = from + pause; at <= to; at += every) {
    keys.push_back(at);
  }
  return keys;
}

TEST(DeadMan, CountsAsHeldFromTheSecondRepeatOn) {
  const auto held = held_at(held_key(1000ms, 3000ms), 3000ms);
  ASSERT_FALSE(held.empty());
  EXPECT_EQ(held.front(), 1530ms);
  EXPECT_EQ(held.back(), 3000ms);
  EXPECT_EQ(held.size(), (3000ms - 1530ms) / 2ms + 1);
}

TEST(DeadMan, IsLetGoAfterSilence) {
  const auto held = held_at(held_key(1000ms, 2000ms), 5000ms);
  ASSERT_FALSE(held.empty());
  EXPECT_EQ(held.back(), 1980ms + DeadMan::kSilence);
}

TEST(DeadMan, TakesNoTapForHolding) {
  EXPECT_TRUE(held_at({1000ms}, 5000ms).empty());
  EXPECT_TRUE(held_at({1000ms, 1300ms, 1600ms, 1900ms}, 5000ms).empty());
}

TEST(DeadMan, TakesNoPastedTextForHolding) {
  std::vector<Duration> keys;
  for (Duration at = 1000ms; at < 3000ms; at += 5ms) {
    keys.push_back(at);
  }
  EXPECT_TRUE(held_at(keys, 5000ms).empty());
}

TEST(DeadMan, TakesManyKeysAtOnceForOne) { EXPECT_TRUE(held_at(std::vector<Duration>(1000, 1000ms), 5000ms).empty()); }

TEST(DeadMan, KeysThatWereHeldUpOnTheWayMoveNothingUntilTheKeyWasLetGo) {
  std::vector<Duration> keys = held_key(1000ms, 2000ms);
  for (Duration at = 2200ms; at <= 4000ms; at += 30ms) {  // after a pause the repeats go on, as if nothing had been
    keys.push_back(at);
  }
  EXPECT_EQ(held_at(keys, 4000ms).back(), 1980ms + DeadMan::kSilence);
  for (const Duration at : held_key(4500ms, 6000ms)) {
    keys.push_back(at);
  }
  EXPECT_EQ(held_at(keys, 6000ms).back(), 6000ms);
}

TEST(DeadMan, WorksWithShortAndLongPauses) {
  EXPECT_FALSE(held_at(held_key(1000ms, 4000ms, 200ms), 4000ms).empty());
  EXPECT_FALSE(held_at(held_key(1000ms, 4000ms, 1100ms), 4000ms).empty());
  EXPECT_FALSE(held_at(held_key(1000ms, 4000ms, 500ms, 100ms), 4000ms).empty());
}

TEST(DeadMan, WhatIsForbiddenCountsFromTheNextPressOn) {
  DeadMan dead_man;
  std::vector<Duration> keys = held_key(1000ms, 3000ms);
  std::size_t next = 0;
  for (Duration now = 2ms; now <= 3000ms; now += 2ms) {
    dead_man.update(Instant(now));
    if (next < keys.size() && keys[next] <= now) {
      dead_man.press(Instant(now));
      ++next;
    }
    if (now == 2000ms) {
      ASSERT_TRUE(dead_man.held());
      dead_man.forbid();
    }
    EXPECT_FALSE(now >= 2000ms && dead_man.held());
  }
}

TEST(DeadMan, IsNeverHeldLongerThanSilenceAfterTheLastKey) {
  constexpr unsigned kSeed = 20250611;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  for (int run = 0; run < 200; ++run) {
    std::vector<Duration> keys;
    Duration at = 0ms;
    for (int i = 0; i < 60; ++i) {
      at +=
          Duration(std::chrono::milliseconds(2 * std::uniform_int_distribution<int>(1, i % 7 == 0 ? 600 : 90)(random)));
      keys.push_back(at);
    }
    for (const Duration held : held_at(keys, at + 1000ms)) {
      const auto after = std::upper_bound(keys.begin(), keys.end(), held);
      ASSERT_NE(after, keys.begin());
      EXPECT_LE(held - *(after - 1), DeadMan::kSilence);
      EXPECT_GE(after - keys.begin(), 3) << "a press and two repeats come first";
    }
  }
}

}  // namespace
}  // namespace ivo::firmware
