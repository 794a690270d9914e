#include "firmware/files/ros_map_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/files/map_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"
#include "tests/unit/firmware/files/written_png.hpp"

namespace ivo::firmware {
namespace {

using enum SemanticClass;

const std::string kRosMap =
    "image: a.pgm\nresolution: 0.050000\norigin: [-1.5, 2.25, 0.000000]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";
// Free and occupied over unknown and free.
const std::string kRosPixels = std::string("P5\n# by hand\n2 2\n255\n") + "\xfe" + std::string(1, '\0') + "\xcd\xff";

std::string complaint_about_ros_map(const std::string& yaml, const std::string& pgm = kRosPixels) {
  const ScratchFolder folder;
  folder.put("a.pgm", pgm);
  std::string message = message_of(read_map(folder.put("a.yaml", yaml)));
  for (std::size_t at; (at = message.find(folder.path() + "/")) != std::string::npos;) {
    message.erase(at, folder.path().size() + 1);
  }
  return message;
}

std::vector<SemanticClass> ros_classes(const std::string& yaml, const std::string& pgm) {
  const ScratchFolder folder;
  folder.put("a.pgm", pgm);
  const auto map = read_map(folder.put("a.yaml", yaml));
  EXPECT_TRUE(map.ok()) << message_of(map);
  return map.ok() ? map.value().pixels : std::vector<SemanticClass>{};
}

TEST(RosMapFile, FreeIsPavementOccupiedIsWallAndUnknownIsAnObstacleToo) {
  const ScratchFolder folder;
  folder.put("a.pgm", kRosPixels);
  const auto map = read_map(folder.put("a.yaml", kRosMap));
  ASSERT_TRUE(map.ok()) << map.error().message;
  EXPECT_EQ(map.value().pixels, (std::vector<SemanticClass>{kBuilding, kPavement, kPavement, kWall}));
  EXPECT_EQ(map.value().width_px, 2);
  EXPECT_EQ(map.value().height_px, 2);
  EXPECT_EQ(map.value().resolution_m, 0.05);
  EXPECT_EQ(map.value().origin_m, (Point{-1.5, 2.25}));
  EXPECT_EQ(map.value().image_path, folder.path("a.pgm"));
  EXPECT_TRUE(map.value().view().obstacle(0, 0));
  EXPECT_FALSE(map.value().view().obstacle(1, 0));
  EXPECT_TRUE(map.value().view().obstacle(1, 1));
}

TEST(RosMapFile, TextImagesQuotesCommentsAndListsByLineAreFine) {
  EXPECT_EQ(
      ros_classes("# saved by hand\n---\nfree_thresh: .25 # of 1\nimage: \"a.pgm\"\nmode: scale\nresolution: 1e-1\n"
                  "origin:\n- 0.0\n- -1\n- 0\nnegate: false\noccupied_thresh: 0.65\n\n",
                  "P2 3 1 100\n0 # black\n50 100"),
      (std::vector<SemanticClass>{kWall, kBuilding, kPavement}));
}

TEST(RosMapFile, NegatedImagesHaveBlackFree) {
  EXPECT_EQ(ros_classes(replaced(kRosMap, "negate: 0", "negate: 1"), "P2 3 1 255 0 128 255"),
            (std::vector<SemanticClass>{kPavement, kBuilding, kWall}));
}

TEST(RosMapFile, RawImagesHoldOccupancyInPercent) {
  EXPECT_EQ(ros_classes(kRosMap + "mode: raw\n", "P2 5 1 255 0 19 50 100 255"),
            (std::vector<SemanticClass>{kPavement, kPavement, kBuilding, kWall, kBuilding}));
}

TEST(RosMapFile, SixteenBitsAreReadWhole) {
  EXPECT_EQ(ros_classes(kRosMap, std::string("P5 2 1 65535\n") + "\xff\xff" + std::string(2, '\0')),
            (std::vector<SemanticClass>{kPavement, kWall}));
}

TEST(RosMapFile, AnImageMayBeAPng) {
  const ScratchFolder folder;
  folder.put("a.png", written_png(3, 1, {.type = PNG_COLOR_TYPE_GRAY}, {254, 0, 205}));
  const auto map = read_map(folder.put("a.yaml", replaced(kRosMap, "a.pgm", "a.png")));
  ASSERT_TRUE(map.ok()) << map.error().message;
  EXPECT_EQ(map.value().pixels, (std::vector<SemanticClass>{kPavement, kWall, kBuilding}));
}

TEST(RosMapFile, TransparentPixelsAreRefusedBecauseTheyMightLookFree) {
  const ScratchFolder folder;
  folder.put("a.png", written_png(1, 1, {.type = PNG_COLOR_TYPE_GRAY_ALPHA}, {254, 0}));
  EXPECT_EQ(message_of(read_map(folder.put("a.yaml", replaced(kRosMap, "a.pgm", "a.png")))),
            folder.path("a.yaml") + ":1: image: " + folder.path("a.png") +
                ": has transparent pixels; expected an opaque image, grey for unknown");
}

TEST(RosMapFile, RefusesATurnedMapByName) {
  EXPECT_EQ(complaint_about_ros_map(replaced(kRosMap, "0.000000]", "0.1]")),
            "a.yaml:3: origin: is turned by a yaw of 0.1 rad; expected 0, a map that is not turned");
}

TEST(RosMapFile, RefusesByLineWhatWillNotDo) {
  EXPECT_EQ(complaint_about_ros_map(replaced(kRosMap, "[-1.5, 2.25, 0.000000]", "[1, 2]")),
            "a.yaml:3: origin: is no pose; expected [x, y, yaw]");
  EXPECT_EQ(complaint_about_ros_map(replaced(kRosMap, "0.050000", "nan")),
            "a.yaml:2: resolution: \"nan\" will not do; expected a number, 0.001 to 100");
  EXPECT_EQ(complaint_about_ros_map(replaced(kRosMap, "negate: 0", "negate: maybe")),
            "a.yaml:4: negate: \"maybe\" will not do; expected 0, 1, false or true");
  EXPECT_EQ(complaint_about_ros_map(replaced(kRosMap, "0.196", "0.65")),
            "a.yaml:6: free_thresh: is not below occupied_thresh; expected free_thresh < occupied_thresh");
  EXPECT_EQ(complaint_about_ros_map(kRosMap + "mode: fancy\n"),
            "a.yaml:7: mode: \"fancy\" is unknown; expected trinary, scale or raw");
  EXPECT_EQ(complaint_about_ros_map(replaced(kRosMap, "negate: 0\n", "")), "a.yaml: negate: missing; it must be given");
  EXPECT_EQ(complaint_about_ros_map(kRosMap + "negate: 0\n"),
            "a.yaml:7: negate: stands in line 4 too; expected each key once");
  EXPECT_EQ(complaint_about_ros_map(kRosMap + "layers: 2\n"),
            "a.yaml:7: layers: unknown; expected one of image, resolution, origin, negate, occupied_thresh, "
            "free_thresh, mode");
  EXPECT_EQ(complaint_about_ros_map(kRosMap + "just words\n"),
            "a.yaml:7: is not KEY: VALUE at the line's beginning; expected a key a line, without tables");
  EXPECT_EQ(complaint_about_ros_map(replaced(kRosMap, "image: a.pgm", "image: &a a.pgm")),
            "a.yaml:1: image: is neither a plain scalar nor a list of them; expected that on one line");
  EXPECT_EQ(complaint_about_ros_map(kRosMap + "mode:\n"),
            "a.yaml:7: ends before the list that was begun; expected lines that begin with -");
}

TEST(RosMapFile, RefusesImagesThatAreNone) {
  EXPECT_EQ(complaint_about_ros_map(kRosMap, "P6 1 1 255 abc"),
            "a.yaml:1: image: a.pgm: not a PGM; expected one that begins with P5 or P2");
  EXPECT_EQ(complaint_about_ros_map(kRosMap, kRosPixels.substr(0, kRosPixels.size() - 1)),
            "a.yaml:1: image: a.pgm: cut short; expected 4 pixels after its header");
  EXPECT_EQ(complaint_about_ros_map(kRosMap, kRosPixels + "x"),
            "a.yaml:1: image: a.pgm: goes on after its last pixel; expected one image and nothing more");
  EXPECT_EQ(complaint_about_ros_map(kRosMap, "P5 0 2 255 "),
            "a.yaml:1: image: a.pgm: its header will not do; expected width, height and a white of 1 to 65535");
  EXPECT_EQ(complaint_about_ros_map(kRosMap, "P5 100000 100000 255 "),
            "a.yaml:1: image: a.pgm: 100000 x 100000 pixels are too many; expected at most 64000000");
  EXPECT_EQ(complaint_about_ros_map(kRosMap, "P2 2 1 9 5 10"),
            "a.yaml:1: image: a.pgm: pixel 1 is 10; expected at most 9, white");
}

}  // namespace
}  // namespace ivo::firmware
