#include "config/base/spsc_ring.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <random>
#include <thread>

namespace ivo {
namespace {

TEST(SpscRing, GivesValuesBackInOrder) {
  SpscRing<int, 4> ring;
  EXPECT_TRUE(ring.push(1));
  EXPECT_TRUE(ring.push(2));
  int value = 0;
  ASSERT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 1);
  ASSERT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 2);
}

TEST(SpscRing, LeavesTheValueAloneWhenEmpty) {
  SpscRing<int, 4> ring;
  int value = 7;
  EXPECT_FALSE(ring.pop(value));
  EXPECT_EQ(value, 7);
}

TEST(SpscRing, HoldsItsWholeCapacityThenDropsTheNewestAndCountsIt) {
  SpscRing<int, 4> ring;
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(ring.push(i));
  }
  EXPECT_FALSE(ring.push(98));
  EXPECT_FALSE(ring.push(99));
  EXPECT_EQ(ring.lost(), 2U);
  int value = -1;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(value));
}

TEST(SpscRing, KeepsOrderOverManyTurnsOfItsIndex) {
  SpscRing<int, 4> ring;
  std::mt19937 random(5);
  int written = 0;
  int read = 0;
  for (int i = 0; i < 10'000; ++i) {
    if (random() % 2 == 0) {
      written += ring.push(written) ? 1 : 0;
    } else if (int value = 0; ring.pop(value)) {
      ASSERT_EQ(value, read++);
    }
  }
  EXPECT_GT(read, 1000);
}

// Whatever the two threads' pace, what arrives arrives in order, and what does not is in the count.
TEST(SpscRing, LosesNothingUnsaidBetweenTwoThreads) {
  struct Item {
    std::uint64_t number;
    std::uint64_t check;
  };
  static SpscRing<Item, 64> ring;
  constexpr std::uint64_t kItems = 200'000;
  constexpr std::uint64_t kSalt = 0x9E3779B97F4A7C15ULL;
  std::atomic<bool> written{false};
  std::thread writer([&] {
    std::mt19937 random(17);
    for (std::uint64_t n = 0; n < kItems; ++n) {
      ring.push({n, n * kSalt});
      if (random() % 128 == 0) {
        std::this_thread::yield();
      }
    }
    written.store(true, std::memory_order_release);
  });
  std::uint64_t arrived = 0;
  std::uint64_t next = 0;
  bool in_order = true;
  bool whole = true;
  for (;;) {
    const bool last_look = written.load(std::memory_order_acquire);
    Item item{};
    while (ring.pop(item)) {
      in_order = in_order && item.number >= next;
      whole = whole && item.check == item.number * kSalt;
      next = item.number + 1;
      ++arrived;
    }
    if (last_look) {
      break;
    }
    std::this_thread::yield();
  }
  writer.join();
  EXPECT_TRUE(in_order);
  EXPECT_TRUE(whole);
  EXPECT_GT(arrived, 0U);
  EXPECT_EQ(arrived + ring.lost(), kItems);
}

}  // namespace
}  // namespace ivo
