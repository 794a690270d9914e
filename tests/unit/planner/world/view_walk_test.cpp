#include "planner/world/view_walk.hpp"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using Row = std::tuple<int, int, std::uint64_t, int>;  // row, byte, word, first point

std::vector<Row> rows_of(const SightTable& sight, const SightView& view) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const Swath& swath = view.at(i);
    for (int k = 0; k < swath.rows; ++k) {
      rows.emplace_back(swath.first_row + k, swath.first_byte, sight.words(swath)[k], swath.first_point);
    }
  }
  return rows;
}

class ViewWalkTest : public testing::TestWithParam<int> {
 protected:
  ViewWalkTest() {
    m1_.problem().graph.spacing_m = 5.0;
    EXPECT_FALSE(test::shared_planner().prepare(m1_.problem()));
  }
  static const SightTable& sight() { return test::shared_planner().world().sight; }
  static const Graph& graph() { return test::shared_planner().world().graph; }

  test::M1 m1_{1};
};

TEST_P(ViewWalkTest, TellsEachRowOnceInOrderAndEachSwathsEnd) {
  bool reversed = false;
  for (Edge e = graph().first_edge(20); e < graph().end_edge(20); ++e) {
    const SightView view = sight().along_edge(0, e);
    reversed = reversed || view.reversed;
    ViewWalk walk;
    walk.begin(view);
    EXPECT_EQ(walk.reversed(), view.reversed);
    std::vector<Row> rows;
    std::size_t ends = 0;
    while (!walk.done()) {
      const auto [swath, words, ends_swath] = walk.next(sight(), GetParam());
      ASSERT_GT(swath.rows, 0);
      EXPECT_LE(swath.rows, GetParam());
      for (int k = 0; k < swath.rows; ++k) {
        rows.emplace_back(swath.first_row + k, swath.first_byte, words[k], swath.first_point);
      }
      ends += ends_swath ? 1 : 0;
    }
    EXPECT_EQ(rows, rows_of(sight(), view));
    EXPECT_EQ(ends, view.size());
  }
  EXPECT_TRUE(reversed);
}

TEST(ViewWalk, OfNothingIsDone) {
  ViewWalk walk;
  walk.begin(SightView{});
  EXPECT_TRUE(walk.done());
}

INSTANTIATE_TEST_SUITE_P(Parts, ViewWalkTest, testing::Values(1, 7, 1000));

}  // namespace
}  // namespace ivo::planner
