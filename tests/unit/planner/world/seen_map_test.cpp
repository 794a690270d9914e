#include "planner/world/seen_map.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace ivo::planner {
namespace {

class SeenMapTest : public testing::Test {
 protected:
  std::unique_ptr<SeenMap> map_ = std::make_unique<SeenMap>();
};

TEST_F(SeenMapTest, HasNothingAtFirst) {
  map_->open(100, 30);
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 100; ++column) {
      ASSERT_FALSE(map_->test(column, row));
    }
  }
}

TEST_F(SeenMapTest, KeepsEachCellApartOnNarrowMapsAndWideOnes) {
  for (const int columns : {1, 2, 7, 8, 9, 63, 64, 65, 130}) {
    constexpr int kRows = 5;
    for (int set = 0; set < columns * kRows; ++set) {
      map_->open(columns, kRows);
      map_->set(set % columns, set / columns);
      for (int c = 0; c < columns * kRows; ++c) {
        ASSERT_EQ(map_->test(c % columns, c / columns), c == set) << columns << " columns, cell " << set;
      }
    }
  }
}

TEST_F(SeenMapTest, SetsARunAndNothingBeside) {
  map_->open(70, 3);
  for (int first = 0; first < 70; ++first) {
    for (int last = first; last < 70; ++last) {
      map_->open(70, 3);
      map_->set_run(1, first, last);
      for (int column = 0; column < 70; ++column) {
        ASSERT_EQ(map_->test(column, 1), column >= first && column <= last);
        ASSERT_FALSE(map_->test(column, 0));
        ASSERT_FALSE(map_->test(column, 2));
      }
    }
  }
}

TEST_F(SeenMapTest, TakesAnEmptyRun) {
  map_->open(70, 1);
  map_->set_run(0, 5, 4);
  EXPECT_EQ(map_->window(0, 0), 0U);
}

// Every window that begins on the map can be read and written, also at its last column and row.
TEST_F(SeenMapTest, HasRoomForAWindowAtTheEdge) {
  for (const int columns : {1, 8, 9, 64, 100}) {
    map_->open(columns, 4);
    const int last_byte = (columns - 1) / 8;
    EXPECT_LE(3 * map_->stride() + last_byte + 8, map_->bytes());
    map_->set_window(3, last_byte, 1);
    EXPECT_TRUE(map_->test(8 * last_byte, 3));
    EXPECT_EQ(map_->window(3, last_byte), 1U);
    map_->set(columns - 1, 2);
    EXPECT_EQ(map_->window(2, last_byte), std::uint64_t{1} << static_cast<unsigned>((columns - 1) % 8));
    // What hangs over is no cell of another row.
    map_->open(columns, 4);
    map_->set_window(1, last_byte, ~std::uint64_t{0});
    EXPECT_EQ(map_->window(2, 0), 0U);
  }
}

TEST_F(SeenMapTest, FitsWhatHasRoomAndNotMore) {
  EXPECT_TRUE(SeenMap::fits(1, SeenMap::kBytes / 8));
  EXPECT_FALSE(SeenMap::fits(1, SeenMap::kBytes / 8 + 1));
  const int side = 1 << ((std::bit_width(static_cast<unsigned>(limits::kCells)) - 1) / 2);
  EXPECT_TRUE(SeenMap::fits(side, limits::kCells / side));
  EXPECT_TRUE(SeenMap::fits(limits::kCells, 1));
  EXPECT_FALSE(SeenMap::fits(1, limits::kCells));
  const int rows = SeenMap::kBytes / SeenMap::stride_of(9);
  map_->open(9, rows);
  EXPECT_LE(map_->bytes(), SeenMap::kBytes);
  map_->set(8, rows - 1);
  map_->set_window(rows - 1, 1, ~std::uint64_t{0});
  EXPECT_TRUE(map_->test(8, rows - 1));
}

struct RandomSwath {
  Swath swath;
  std::vector<std::uint64_t> words;
};

RandomSwath draw(std::mt19937_64& random, int columns, int rows) {
  RandomSwath drawn;
  const auto below = [&](int count) { return static_cast<int>(random() % static_cast<std::uint64_t>(count)); };
  drawn.swath.first_byte = below((columns - 1) / 8 + 1);
  drawn.swath.first_row = below(rows);
  drawn.swath.rows = static_cast<std::int16_t>(1 + below(rows - drawn.swath.first_row));
  const int left = columns - 8 * drawn.swath.first_byte;
  const std::uint64_t mask = left >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << static_cast<unsigned>(left)) - 1;
  for (int i = 0; i < drawn.swath.rows; ++i) {
    drawn.words.push_back(random() & random() & mask);
  }
  return drawn;
}

TEST_F(SeenMapTest, LooksAsASetOfCellsWould) {
  std::mt19937_64 random(3);
  const auto counting = std::make_unique<SeenMap>();
  for (const int columns : {3, 8, 61, 64, 90, 200}) {
    constexpr int kRows = 17;
    map_->open(columns, kRows);
    counting->open(columns, kRows);
    std::set<Cell> seen;
    for (int i = 0; i < 40; ++i) {
      const RandomSwath drawn = draw(random, columns, kRows);
      std::set<Cell> fresh;
      for (int row = 0; row < drawn.swath.rows; ++row) {
        for_each_bit(drawn.words[index(row)], [&](int bit) {
          const Cell c = (drawn.swath.first_row + row) * columns + 8 * drawn.swath.first_byte + bit;
          if (!seen.contains(c)) {
            fresh.insert(c);
          }
        });
      }
      ASSERT_EQ(map_->any_new(drawn.swath, drawn.words.data()), !fresh.empty());
      std::set<Cell> told;
      map_->look(drawn.swath, drawn.words.data(), [&](int row, std::uint64_t word) {
        ASSERT_NE(word, 0U);
        for_each_bit(word,
                     [&](int bit) { ASSERT_TRUE(told.insert(map_->cell(row, drawn.swath.first_byte, bit)).second); });
      });
      ASSERT_EQ(told, fresh);
      ASSERT_EQ(counting->look_and_count(drawn.swath, drawn.words.data()), static_cast<int>(fresh.size()));
      seen.insert(fresh.begin(), fresh.end());
      ASSERT_FALSE(map_->any_new(drawn.swath, drawn.words.data()));
    }
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < columns; ++column) {
        ASSERT_EQ(map_->test(column, row), seen.contains(row * columns + column));
        ASSERT_EQ(counting->test(column, row), seen.contains(row * columns + column));
      }
    }
  }
}

TEST_F(SeenMapTest, CopiesAllOfAnother) {
  map_->open(33, 7);
  map_->set(32, 6);
  const auto copy = std::make_unique<SeenMap>();
  copy->open(200, 50);
  copy->set(5, 5);
  copy->copy(*map_);
  EXPECT_EQ(copy->stride(), map_->stride());
  EXPECT_EQ(copy->bytes(), map_->bytes());
  EXPECT_TRUE(copy->test(32, 6));
  EXPECT_FALSE(copy->test(5, 5));
  EXPECT_EQ(copy->cell(1, 0, 0), 33);
}

TEST(ForEachBit, GivesEachOnceLowestFirst) {
  std::vector<int> bits;
  for_each_bit(0x8000'0001'0000'0005U, [&](int bit) { bits.push_back(bit); });
  EXPECT_EQ(bits, (std::vector<int>{0, 2, 32, 63}));
  for_each_bit(0, [&](int) { FAIL(); });
}

}  // namespace
}  // namespace ivo::planner
