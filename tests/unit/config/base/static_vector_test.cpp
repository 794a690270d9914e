#include "config/base/static_vector.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ivo {
namespace {

TEST(StaticVector, StartsEmpty) {
  const StaticVector<int, 3> v;
  EXPECT_TRUE(v.empty());
  EXPECT_FALSE(v.full());
  EXPECT_EQ(v.size(), 0U);
  EXPECT_EQ(v.begin(), v.end());
}

TEST(StaticVector, RefusesWhatDoesNotFitAndKeepsWhatItHas) {
  StaticVector<int, 2> v;
  EXPECT_TRUE(v.push_back(1));
  EXPECT_TRUE(v.push_back(2));
  EXPECT_TRUE(v.full());
  EXPECT_FALSE(v.push_back(3));
  EXPECT_EQ(v.size(), 2U);
  EXPECT_EQ(v[0], 1);
  EXPECT_EQ(v.back(), 2);
}

TEST(StaticVector, BehavesAsAVectorUnderAnySequenceOfCalls) {
  std::mt19937 random(11);
  StaticVector<unsigned, 16> v;
  std::vector<unsigned> model;
  for (int i = 0; i < 20'000; ++i) {
    const unsigned what = static_cast<unsigned>(random());
    if (what % 16 < 9) {
      ASSERT_EQ(v.push_back(what), model.size() < 16);
      if (model.size() < 16) {
        model.push_back(what);
      }
    } else if (what % 16 < 15) {
      if (!model.empty()) {
        v.pop_back();
        model.pop_back();
      }
    } else {
      v.clear();
      model.clear();
    }
    ASSERT_EQ(std::vector<unsigned>(v.begin(), v.end()), model);
    ASSERT_EQ(v.span().size(), model.size());
  }
}

TEST(StaticVectorDeathTest, ReachingOutsideEndsTheProgram) {
  StaticVector<int, 2> v;
  ASSERT_TRUE(v.push_back(1));
  EXPECT_DEATH((void)v[1], "");
  EXPECT_DEATH(v.resize(3), "");
  v.clear();
  EXPECT_DEATH(v.pop_back(), "");
  EXPECT_DEATH((void)v.back(), "");
}

}  // namespace
}  // namespace ivo
