#include "firmware/tools/beyond_capacity.hpp"

#include <gtest/gtest.h>

#include <string>

namespace ivo::firmware {
namespace {

using planner::RefusalCode;

std::string sentence(RefusalCode code, double value, double limit) {
  const Lines lines("m.toml", {{"planner.cell_m", 5}, {"planner.spacing_m", 6}});
  const std::optional<Error> error = beyond_capacity({.code = code, .value = value, .limit = limit}, lines);
  return error ? error->message : std::string();
}

TEST(BeyondCapacity, NamesWhatIsTooManyAndTheProfileThatFits) {
  EXPECT_EQ(
      sentence(RefusalCode::kTooManyCells, 70'000, 65'536),
      "m.toml:5: planner.cell_m: the map has too many cells: 70000, more than this build's 65536; expected a larger "
      "cell_m; the planner profile that fits is onboard (-DIVO_PLANNER_PROFILE)");
  EXPECT_EQ(
      sentence(RefusalCode::kTooManySquares, 8'193, 8'192),
      "m.toml:6: planner.spacing_m: the graph has too many squares: 8193, more than this build's 8192; expected a "
      "larger spacing_m; the planner profile that fits is desktop (-DIVO_PLANNER_PROFILE)");
  EXPECT_EQ(sentence(RefusalCode::kTooManyNodes, 4'097, 4'096),
            "m.toml:6: planner.spacing_m: the graph has too many nodes: 4097, more than this build's 4096; expected a "
            "larger spacing_m; the planner profile that fits is desktop (-DIVO_PLANNER_PROFILE)");
  EXPECT_EQ(
      sentence(RefusalCode::kTooManyEdges, 14'337, 14'336),
      "m.toml:6: planner.spacing_m: the graph has too many edges: 14337, more than this build's 14336; expected a "
      "larger spacing_m; the planner profile that fits is onboard (-DIVO_PLANNER_PROFILE)");
  EXPECT_EQ(
      sentence(RefusalCode::kSightTableFull, 9'000'000, 7'400'000),
      "m.toml:5: planner.cell_m: the sight table has too many rows: 9000000, more than this build's 7400000; "
      "expected a larger cell_m or spacing_m, or a smaller sight_radius_m; the planner profile that fits is desktop "
      "(-DIVO_PLANNER_PROFILE)");
  EXPECT_EQ(
      sentence(RefusalCode::kTooManySwaths, 40'000, 30'000),
      "m.toml:5: planner.cell_m: the sight table has too many swaths: 40000, more than this build's 30000; expected "
      "a larger cell_m or spacing_m; the planner profile that fits is onboard (-DIVO_PLANNER_PROFILE)");
}

TEST(BeyondCapacity, SaysThatNoProfileFits) {
  EXPECT_EQ(sentence(RefusalCode::kTooManyCells, 4'194'305, 4'194'304),
            "m.toml:5: planner.cell_m: the map has too many cells: 4194305, more than this build's 4194304; expected a "
            "larger cell_m; no planner profile is that large");
  EXPECT_EQ(sentence(RefusalCode::kEdgeTooLong, 1'200, 1'023),
            "m.toml:5: planner.cell_m: an edge has 1200 sight points, more than 1023; expected a larger cell_m or a "
            "smaller spacing_m; no planner profile is that large");
}

TEST(BeyondCapacity, HasNothingToSayOfOtherRefusals) {
  EXPECT_EQ(sentence(RefusalCode::kPriorWithoutMass, 0, 0), "");
  EXPECT_EQ(sentence(RefusalCode::kNone, 0, 0), "");
}

}  // namespace
}  // namespace ivo::firmware
