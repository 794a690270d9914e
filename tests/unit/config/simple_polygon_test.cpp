#include "config/simple_polygon.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ivo {
namespace {

PolygonVerdict verdict_on(const std::vector<Point>& polygon) { return judge_polygon(polygon); }

TEST(SimplePolygon, IsOneWhicheverWayRoundAndHoweverBent) {
  EXPECT_EQ(verdict_on({{0, 0}, {4, 0}, {0, 3}}).fault, PolygonFault::kNone);
  EXPECT_EQ(verdict_on({{0, 3}, {4, 0}, {0, 0}}).fault, PolygonFault::kNone);
  EXPECT_EQ(verdict_on({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}).fault, PolygonFault::kNone);
  EXPECT_EQ(verdict_on({{0, 0}, {2, 0}, {4, 0}, {4, 4}}).fault, PolygonFault::kNone) << "a vertex on a straight side";
}

TEST(SimplePolygon, HasThreeVerticesAtLeast) {
  EXPECT_EQ(verdict_on({}).fault, PolygonFault::kTooFew);
  EXPECT_EQ(verdict_on({{0, 0}, {4, 0}}).fault, PolygonFault::kTooFew);
}

TEST(SimplePolygon, NamesTheVerticesThatAreTheSame) {
  const PolygonVerdict verdict = verdict_on({{0, 0}, {4, 0}, {4, 3}, {0, 0}});
  EXPECT_EQ(verdict.fault, PolygonFault::kTwice);
  EXPECT_EQ(verdict.first, 3U);
  EXPECT_EQ(verdict.second, 0U);
}

TEST(SimplePolygon, CoversSomething) { EXPECT_EQ(verdict_on({{0, 0}, {1, 1}, {3, 3}}).fault, PolygonFault::kNoArea); }

TEST(SimplePolygon, NamesTheSidesThatMeet) {
  const PolygonVerdict bow_tie = verdict_on({{0, 0}, {4, 4}, {4, 0}, {0, 4}});
  EXPECT_EQ(bow_tie.fault, PolygonFault::kCrosses);
  EXPECT_EQ(bow_tie.first, 0U);
  EXPECT_EQ(bow_tie.second, 2U);
  EXPECT_EQ(verdict_on({{0, 0}, {4, 0}, {4, 4}, {4, 0}}).fault, PolygonFault::kCrosses) << "folds back";
  EXPECT_EQ(verdict_on({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}).fault, PolygonFault::kCrosses) << "touches itself";
}

}  // namespace
}  // namespace ivo
