#include "planner/numeric/rng.hpp"

#include <gtest/gtest.h>

#include <array>

namespace ivo::planner {
namespace {

TEST(Rng, GivesTheReferenceValuesOfSplitMix64) {
  Rng rng(1234567);
  for (const std::uint64_t expected : {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL,
                                       4593380528125082431ULL, 16408922859458223821ULL}) {
    EXPECT_EQ(rng.next(), expected);
  }
  Rng zero;
  for (const std::uint64_t expected : {0xE220A8397B1DCDAFULL, 0x6E789E6AA1B965F4ULL, 0x06C45D188009454FULL}) {
    EXPECT_EQ(zero.next(), expected);
  }
}

TEST(Rng, UnitIsTheUpperBitsOfTheNextValue) {
  Rng a(9);
  Rng b(9);
  for (int i = 0; i < 1000; ++i) {
    const double unit = a.unit();
    ASSERT_EQ(unit, static_cast<double>(b.next() >> 11U) / 9007199254740992.0);
    ASSERT_GE(unit, 0.0);
    ASSERT_LT(unit, 1.0);
  }
}

TEST(Rng, BelowTakesEveryValueAboutEquallyOftenAndNoOther) {
  Rng rng(4);
  std::array<int, 7> times{};
  for (int i = 0; i < 70'000; ++i) {
    ++times.at(static_cast<std::size_t>(rng.below(7)));
  }
  for (const int n : times) {
    EXPECT_NEAR(n, 10'000, 500);
  }
  EXPECT_EQ(rng.below(1), 0);
}

}  // namespace
}  // namespace ivo::planner
