#include "firmware/files/keepout_mask.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/files/ros_map_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ivo::firmware {
namespace {

TEST(KeepoutMask, KeepsOutWhoseCentreLiesInAnAreaAndObstacles) {
  // Three columns, two rows of half a metre; the area covers the centre of the lower left pixel alone.
  const std::vector<Polygon> no_go = {{{-5, -5}, {0.4, -5}, {0.4, 0.4}, {-5, 0.4}}};
  const std::vector<std::uint8_t> obstacles = {0, 0, 0, 0, 0, 1};
  const KeepoutMask mask = keepout_mask({3, 2, 0.5, {-1.5, 2}, obstacles, no_go}, "keepout.pgm");
  EXPECT_EQ(mask.pgm, std::string("P5\n3 2\n255\n\xfe\xfe\0\0\xfe\xfe", 17));
  EXPECT_EQ(mask.yaml,
            "image: keepout.pgm\nmode: trinary\nresolution: 0.5\norigin: [-1.5, 2, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(KeepoutMask, ReadsBackAsAMapWithItsObstacles) {
  const std::vector<Polygon> no_go = {{{1, 0}, {2, 0}, {2, 1}, {1, 1}}};
  const KeepoutMask mask = keepout_mask({3, 2, 1.0, {7, 8}, {}, no_go}, "keepout.pgm");
  const ScratchFolder folder;
  folder.put("keepout.pgm", mask.pgm);
  const auto map = read_ros_map(folder.put("keepout.yaml", mask.yaml));
  ASSERT_TRUE(map.ok()) << map.error().message;
  EXPECT_EQ(map.value().origin_m, (Point{7, 8}));
  const planner::SegmentedMap view = map.value().view();
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_EQ(view.obstacle(column, row), column == 1 && row == 0) << column << ", " << row;
    }
  }
}

TEST(KeepoutMask, AnAreaBesideTheMapCoversNothingOfIt) {
  const std::vector<Polygon> no_go = {{{10, 10}, {12, 10}, {12, 12}}, {{-9, -9}, {-8, -9}, {-8, -8}}};
  EXPECT_EQ(pixels_within(2, 2, 1.0, no_go), std::string(4, '\0'));
}

}  // namespace
}  // namespace ivo::firmware
