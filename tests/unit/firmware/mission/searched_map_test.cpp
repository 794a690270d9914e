#include "firmware/mission/searched_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "tests/support/drawn_map.hpp"

namespace ivo::firmware {
namespace {

using planner::Cell;

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

/// 10 x 10 m with a wall at x = 5 m up to y = 8 m; as probable everywhere.
class SearchedMapTest : public testing::Test {
 protected:
  SearchedMapTest() : cells_(std::make_unique<planner::Cells>()), belief_(std::make_unique<planner::Belief>()) {
    test::DrawnMap map(10, 10, 0.25);
    map.put(SemanticClass::kWall, 4.75, 0, 5.25, 8);
    EXPECT_FALSE(cells_->build(map.view(), 0.25));
    for (Cell c = 0; c < cells_->count(); ++c) {
      belief_->mass[static_cast<std::size_t>(c)] = 1.0 / cells_->count();
    }
    searched_ = std::make_unique<SearchedMap>(*cells_, *belief_);
  }
  bool seen(double x_m, double y_m) const {
    const int column = static_cast<int>(x_m / cells_->cell_m());
    const int row = static_cast<int>(y_m / cells_->cell_m());
    return searched_->cells().contains(cells_->at(column, row));
  }

  std::unique_ptr<planner::Cells> cells_;
  std::unique_ptr<planner::Belief> belief_;
  std::unique_ptr<SearchedMap> searched_;
};

TEST_F(SearchedMapTest, IsEmptyAtFirst) {
  EXPECT_EQ(searched_->count(), 0U);
  EXPECT_EQ(searched_->mass(), 0.0);
  EXPECT_FALSE(seen(3, 3));
}

TEST_F(SearchedMapTest, HoldsWhatIsWithinTheRadiusAndNothingBeyond) {
  searched_->look(*cells_, {2.6, 5.1}, 2.0);
  EXPECT_TRUE(seen(2.6, 5.1));
  EXPECT_TRUE(seen(2.6, 6.9));
  EXPECT_TRUE(seen(0.9, 5.1));
  EXPECT_FALSE(seen(2.6, 7.6));
  EXPECT_FALSE(seen(4.6, 7.0));
  EXPECT_NEAR(searched_->count() * 0.0625, 3.14159 * 4, 1.0);
}

TEST_F(SearchedMapTest, AWallHidesWhatIsBehindIt) {
  searched_->look(*cells_, {4, 4}, 3.0);
  EXPECT_TRUE(seen(3, 4));
  EXPECT_FALSE(seen(6, 4)) << "2 m away, the wall between";
  searched_->look(*cells_, {6.5, 4}, 1.0);
  EXPECT_TRUE(seen(6, 4));
}

TEST_F(SearchedMapTest, CountsEachCellAndItsMassOnce) {
  searched_->look(*cells_, {2.6, 5.1}, 2.0);
  const std::uint32_t count = searched_->count();
  EXPECT_NEAR(searched_->mass(), static_cast<double>(count) / cells_->count(), 1e-6);
  for (int i = 0; i < 100; ++i) {
    searched_->look(*cells_, {2.6, 5.1}, 2.0);
  }
  EXPECT_EQ(searched_->count(), count);
  searched_->look(*cells_, {2.6, 5.1}, 2.5);
  EXPECT_GT(searched_->count(), count);
  int marked = 0;
  for (Cell c = 0; c < cells_->count(); ++c) {
    marked += searched_->cells().contains(c) ? 1 : 0;
  }
  EXPECT_EQ(static_cast<std::uint32_t>(marked), searched_->count());
}

TEST_F(SearchedMapTest, WhoLooksEverywhereHasSeenNearlyAllOfTheMass) {
  for (double x_m = 0.25; x_m < 10; x_m += 0.5) {
    for (double y_m = 0.25; y_m < 10; y_m += 0.5) {
      searched_->look(*cells_, {x_m, y_m}, 2.0);
    }
  }
  EXPECT_GT(searched_->mass(), 0.95);
  EXPECT_LE(searched_->mass(), 1.0 + 1e-5);
}

TEST_F(SearchedMapTest, NobodyLooksFromOffTheMap) {
  for (const Point place : {Point{-0.1, 5}, Point{5, -0.1}, Point{10, 5}, Point{5, 10}, Point{1e9, 1e9},
                            Point{kNowhere, 5}, Point{5, kNowhere}}) {
    searched_->look(*cells_, place, 3.0);
  }
  EXPECT_EQ(searched_->count(), 0U);
}

TEST_F(SearchedMapTest, LooksFromTheVeryEdge) {
  searched_->look(*cells_, {0, 0}, 1.0);
  searched_->look(*cells_, {9.99, 9.99}, 1.0);
  EXPECT_TRUE(seen(0.1, 0.1));
  EXPECT_TRUE(seen(9.9, 9.9));
}

}  // namespace
}  // namespace ivo::firmware
