#include "firmware/tools/preferred_share.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/areas.hpp"

namespace ivo::firmware {
namespace {

planner::Areas areas(std::initializer_list<planner::Area> list) {
  planner::Areas areas;
  for (const planner::Area& area : list) {
    (void)areas.push_back(area);
  }
  return areas;
}

constexpr std::array<Point, 3> kWay = {{{0, 0}, {10, 0}, {10, 10}}};

TEST(PreferredShare, CutsSegmentsWhereTheyCrossABorder) {
  EXPECT_NEAR(share_inside(kWay, 20, areas({test::rectangle(3, -1, 5, 1)})), 0.1, 1e-12);
  EXPECT_NEAR(share_inside(kWay, 20, areas({test::rectangle(9, -1, 11, 4)})), 0.25, 1e-12);
}

TEST(PreferredShare, CountsWhereAreasOverlapOnce) {
  EXPECT_NEAR(share_inside(kWay, 20, areas({test::rectangle(3, -1, 5, 1), test::rectangle(4, -1, 6, 1)})), 0.15, 1e-12);
}

TEST(PreferredShare, LeavesOutWhatIsBeyondTheLength) {
  EXPECT_NEAR(share_inside(kWay, 4, areas({test::rectangle(3, -1, 5, 1)})), 0.25, 1e-12);
  EXPECT_NEAR(share_inside(kWay, 10, areas({test::rectangle(9, 1, 11, 4)})), 0.0, 1e-12);
}

TEST(PreferredShare, IsNothingForAPathOfNoLength) {
  EXPECT_EQ(share_inside(std::array{Point{4, 0}}, 0, areas({test::rectangle(3, -1, 5, 1)})), 0.0);
}

}  // namespace
}  // namespace ivo::firmware
