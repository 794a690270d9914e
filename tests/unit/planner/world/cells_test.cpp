#include "planner/world/cells.hpp"

#include <gtest/gtest.h>

#include <random>

#include "planner/world/seen_map.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

Cells& cells_of(const SegmentedMap& map, double cell_m) {
  static Cells cells;
  EXPECT_EQ(cells.build(map, cell_m).code, RefusalCode::kNone);
  return cells;
}

TEST(Cells, TakeTheClassOfMostOfTheirPixels) {
  DrawnMap map(1.0, 1.0, 0.25);
  map.put(kBuilding, 0.0, 0.0, 0.5, 0.5).put(kPavement, 0.0, 0.0, 0.25, 0.25);  // three of four
  map.put(kBuilding, 0.5, 0.5, 0.75, 0.75);                                     // one of four
  const Cells& cells = cells_of(map.view(), 0.5);
  EXPECT_TRUE(cells.obstacle(cells.at(0, 0)));
  EXPECT_TRUE(cells.occluder(cells.at(0, 0)));
  EXPECT_FALSE(cells.obstacle(cells.at(1, 1)));
}

TEST(Cells, TakeTheLowestClassOnATie) {
  DrawnMap map(1.0, 0.5, 0.25);
  map.put(kBuilding, 0.0, 0.0, 0.5, 0.25);                                   // two pavement, two building
  map.put(kWater, 0.5, 0.0, 1.0, 0.25).put(kBuilding, 0.5, 0.25, 1.0, 0.5);  // two building, two water
  const Cells& cells = cells_of(map.view(), 0.5);
  EXPECT_FALSE(cells.obstacle(cells.at(0, 0)));
  EXPECT_TRUE(cells.occluder(cells.at(1, 0)));
}

TEST(Cells, TellWhatBlocksMotionFromWhatBlocksSight) {
  DrawnMap map(3.0, 1.0, 1.0);
  map.put(kWater, 0.0, 0.0, 1.0, 1.0).put(kTree, 1.0, 0.0, 2.0, 1.0);
  const Cells& cells = cells_of(map.view(), 1.0);
  EXPECT_TRUE(cells.obstacle(0));
  EXPECT_FALSE(cells.occluder(0));
  EXPECT_TRUE(cells.obstacle(1));
  EXPECT_TRUE(cells.occluder(1));
  EXPECT_FALSE(cells.obstacle(2));
  EXPECT_FALSE(cells.occluder(2));
}

TEST(Cells, OneForEachPixelAreThePixels) {
  DrawnMap map(40.0, 7.5, 0.25);
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const double x = 0.25 * static_cast<double>(random() % 160);
    const double y = 0.25 * static_cast<double>(random() % 30);
    map.put(kWall, x, y, x + 0.25, y + 0.25);
  }
  const SegmentedMap view = map.view();
  const Cells& cells = cells_of(view, 0.25);
  ASSERT_EQ(cells.columns(), 160);
  ASSERT_EQ(cells.rows(), 30);
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 160; ++column) {
      ASSERT_EQ(cells.obstacle(cells.at(column, row)), view.obstacle(column, row)) << column << ", " << row;
    }
  }
}

// Neither resolution divides the other: each cell is recounted over the pixels whose centres it holds.
TEST(Cells, CountPixelCentresWhenResolutionsDoNotDivide) {
  DrawnMap map(7.0, 5.0, 0.1);
  std::mt19937 random(8);
  for (int i = 0; i < 60; ++i) {
    const double x = 0.1 * static_cast<double>(random() % 70);
    const double y = 0.1 * static_cast<double>(random() % 50);
    map.put(static_cast<SemanticClass>(random() % kClasses), x, y, x + 0.9, y + 0.6);
  }
  const SegmentedMap view = map.view();
  const Cells& cells = cells_of(view, 0.37);
  ASSERT_EQ(cells.columns(), 19);
  ASSERT_EQ(cells.rows(), 14);
  for (Cell c = 0; c < cells.count(); ++c) {
    std::array<int, kClasses> votes{};
    for (int row = 0; row < view.height_px; ++row) {
      for (int column = 0; column < view.width_px; ++column) {
        if (static_cast<int>((column + 0.5) * 0.1 / 0.37) == cells.column(c) &&
            static_cast<int>((row + 0.5) * 0.1 / 0.37) == cells.row(c)) {
          ++votes[static_cast<std::size_t>(view.at(column, row))];
        }
      }
    }
    std::size_t winner = 0;
    for (std::size_t k = 1; k < votes.size(); ++k) {
      winner = votes[k] > votes[winner] ? k : winner;
    }
    ASSERT_EQ(cells.obstacle(c), view.classes[winner].obstacle) << "cell " << c;
    ASSERT_EQ(cells.occluder(c), view.classes[winner].occluder) << "cell " << c;
  }
}

TEST(Cells, SmallerThanPixelsTakeThePixelUnderTheirCentre) {
  DrawnMap map(2.0, 1.0, 1.0);
  map.put(kWall, 1.0, 0.0, 2.0, 1.0);
  const Cells& cells = cells_of(map.view(), 0.4);
  ASSERT_EQ(cells.columns(), 5);
  ASSERT_EQ(cells.rows(), 3);
  for (Cell c = 0; c < cells.count(); ++c) {
    EXPECT_EQ(cells.obstacle(c), cells.centre(c).x_m >= 1.0) << "cell " << c;
  }
}

TEST(Cells, AreNumberedRowByRowFromTheBottomAndKnowTheirCentres) {
  const Cells& cells = cells_of(DrawnMap(4.0, 2.0, 0.5).view(), 0.5);
  const Cell c = cells.at(3, 2);
  EXPECT_EQ(c, 19);
  EXPECT_EQ(cells.column(c), 3);
  EXPECT_EQ(cells.row(c), 2);
  EXPECT_EQ(cells.centre(c), (Point{1.75, 1.25}));
}

TEST(Cells, FindAnOccluderInAnyWindowAndOnlyThere) {
  DrawnMap map(8.0, 6.0, 0.5);
  map.put(kWall, 3.0, 2.0, 3.5, 2.5).put(kTree, 6.5, 5.0, 7.0, 5.5).put(kWater, 0.0, 0.0, 1.0, 1.0);
  const Cells& cells = cells_of(map.view(), 0.5);
  std::mt19937 random(6);
  for (int i = 0; i < 2000; ++i) {
    const CellWindow w{static_cast<int>(random() % 16), static_cast<int>(random() % 12), 0, 0};
    const CellWindow window{w.first_column, w.first_row,
                            w.first_column + static_cast<int>(random() % 16) % (16 - w.first_column),
                            w.first_row + static_cast<int>(random() % 12) % (12 - w.first_row)};
    bool any = false;
    for (int row = window.first_row; row <= window.last_row; ++row) {
      for (int column = window.first_column; column <= window.last_column; ++column) {
        any = any || cells.occluder(cells.at(column, row));
      }
    }
    ASSERT_EQ(cells.any_occluder(window), any);
  }
}

TEST(Cells, RefuseMoreThanTheirCapacityWithBothNumbers) {
  static Cells cells;
  const Refusal refusal = cells.build(DrawnMap(40.0, 40.0, 0.5).view(), 0.02);
  EXPECT_EQ(refusal.code, RefusalCode::kTooManyCells);
  EXPECT_EQ(refusal.value, 4'000'000.0);
  EXPECT_EQ(refusal.limit, limits::kCells);
}

TEST(Cells, RefuseANarrowMapByTheRoomThatItsRowsTake) {
  static Cells cells;
  const int rows = limits::kCells / 60 + 64;  // a column each: far fewer cells than there is room for
  ASSERT_FALSE(SeenMap::fits(1, rows * 2));
  const Refusal refusal = cells.build(DrawnMap(0.5, rows, 0.5).view(), 0.5);
  EXPECT_EQ(refusal.code, RefusalCode::kTooManyCells);
  EXPECT_EQ(refusal.value, 2.0 * rows * 4 * SeenMap::stride_of(1));
  EXPECT_EQ(refusal.limit, limits::kCells);
}

}  // namespace
}  // namespace ivo::planner
