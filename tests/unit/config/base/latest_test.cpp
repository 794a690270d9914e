#include "config/base/latest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <thread>

namespace ivo {
namespace {

TEST(Latest, IsTheDefaultValueBeforeTheFirstWrite) {
  Latest<int> latest;
  EXPECT_EQ(latest.read(), 0);
  EXPECT_EQ(latest.read(), 0);
}

TEST(Latest, GivesTheNewestValueAndGivesItAgain) {
  Latest<int> latest;
  latest.write(1);
  latest.write(2);
  EXPECT_EQ(latest.read(), 2);
  EXPECT_EQ(latest.read(), 2);
  latest.write(3);
  EXPECT_EQ(latest.read(), 3);
}

TEST(Latest, FollowsAnyInterleavingOfWritesAndReads) {
  Latest<std::uint32_t> latest;
  std::mt19937 random(3);
  std::uint32_t newest = 0;
  for (std::uint32_t i = 1; i < 10'000; ++i) {
    if (random() % 3 != 0) {
      newest = i;
      latest.write(newest);
    } else {
      ASSERT_EQ(latest.read(), newest);
    }
  }
}

TEST(Latest, IsNeverTornAndNeverGoesBackBetweenTwoThreads) {
  using Block = std::array<std::uint64_t, 64>;
  static Latest<Block> latest;
  constexpr std::uint64_t kWrites = 100'000;
  std::thread writer([] {
    std::mt19937 random(23);
    Block block;
    for (std::uint64_t n = 1; n <= kWrites; ++n) {
      block.fill(n);
      latest.write(block);
      if (random() % 256 == 0) {
        std::this_thread::yield();
      }
    }
  });
  bool whole = true;
  bool forward = true;
  std::uint64_t before = 0;
  while (before < kWrites && whole && forward) {
    const Block& block = latest.read();
    whole = std::all_of(block.begin(), block.end(), [&](std::uint64_t n) { return n == block[0]; });
    forward = block[0] >= before;
    before = block[0];
  }
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(forward);
  EXPECT_EQ(latest.read()[0], kWrites);
}

}  // namespace
}  // namespace ivo
