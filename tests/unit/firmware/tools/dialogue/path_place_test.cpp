#include "firmware/tools/dialogue/path_place.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ivo::firmware {
namespace {

const std::vector<Point> kHook{{0, 0}, {10, 0}, {10, 2}, {0, 2}};

TEST(PathPlace, IsTheFootOfWhoWalksBesideThePath) {
  EXPECT_DOUBLE_EQ(along_path(kHook, {3, 0.7}, 0.0), 3.0);
  EXPECT_DOUBLE_EQ(along_path(kHook, {10.5, 1.0}, 8.0), 11.0);
}

TEST(PathPlace, NeverGoesBack) { EXPECT_DOUBLE_EQ(along_path(kHook, {3, 0}, 5.0), 5.0); }

TEST(PathPlace, IsNotOnALaterLegThatComesBackToTheSamePlace) {
  EXPECT_DOUBLE_EQ(along_path(kHook, {2, 1.2}, 2.0), 2.0) << "the leg at y = 2 is nearer, and 17 m on";
}

TEST(PathPlace, EndsWithThePath) {
  EXPECT_DOUBLE_EQ(along_path(kHook, {-3, 2}, 21.0), 22.0);
  EXPECT_DOUBLE_EQ(along_path(std::vector<Point>{{1, 1}}, {5, 5}, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(along_path({}, {5, 5}, 0.0), 0.0);
}

}  // namespace
}  // namespace ivo::firmware
