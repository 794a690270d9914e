#include "firmware/files/map_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "firmware/files/class_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"
#include "tests/unit/firmware/files/written_png.hpp"

namespace ivo::firmware {
namespace {

using enum SemanticClass;

// Pavement over grass over road; the built-in colours.
const std::vector<std::uint8_t> kThreeRows = {214, 210, 202, 148, 192, 112, 120, 122, 128};

std::string complaint_about_classes(const std::string& text) {
  const ScratchFolder folder;
  return replaced(message_of(read_classes(folder.put("c.toml", text))), folder.path() + "/", "");
}

TEST(MapFile, ReadsAnImageWithTheBuiltInTable) {
  const ScratchFolder folder;
  folder.put("a.png", written_png(1, 3, {}, kThreeRows));
  const auto map = read_map(folder.put("a.toml", "image = 'a.png'\nresolution_m = 0.5\n"));
  ASSERT_TRUE(map.ok()) << map.error().message;
  EXPECT_EQ(map.value().path, folder.path("a.toml"));
  EXPECT_EQ(map.value().image_path, folder.path("a.png"));
  EXPECT_EQ(map.value().pixels, (std::vector<SemanticClass>{kRoad, kGrass, kPavement}));
  const planner::SegmentedMap view = map.value().view();
  EXPECT_EQ(view.width_m(), 0.5);
  EXPECT_EQ(view.height_m(), 1.5);
  EXPECT_EQ(view.at(0, 2), kPavement);
}

TEST(MapFile, ReadsAnImageWithATableOfItsOwn) {
  const ScratchFolder folder;
  folder.put("a.png", written_png(1, 1, {}, {1, 2, 3}));
  folder.put("c.toml", "[[class]]\nname = 'stairs'\ncolour = [1, 2, 3]\nobstacle = true\nrestricted = ['person']\n");
  const auto map = read_map(folder.put("a.toml", "image = 'a.png'\nresolution_m = 1\nclasses = 'c.toml'\n"));
  ASSERT_TRUE(map.ok()) << map.error().message;
  EXPECT_EQ(map.value().pixels, std::vector<SemanticClass>{kStairs});
  const ClassProperties stairs = map.value().view().properties(kStairs);
  EXPECT_TRUE(stairs.obstacle);
  EXPECT_FALSE(stairs.occluder);
  EXPECT_EQ(stairs.restricted, (std::array<bool, 2>{false, true}));
}

TEST(MapFile, RefusesAPixelOfNoClassAndSaysWhereAndWhatIsNearest) {
  const ScratchFolder folder;
  std::vector<std::uint8_t> rows = kThreeRows;
  rows[3] = 150;
  folder.put("a.png", written_png(1, 3, {}, rows));
  EXPECT_EQ(message_of(read_map(folder.put("a.toml", "image = 'a.png'\nresolution_m = 0.5\n"))),
            folder.path("a.png") +
                ": pixel in column 0, row 1 from the top (0.25 m, 0.75 m) is #96c070, the colour of no class; expected "
                "colours of the class table, the nearest is grass #94c070");
}

TEST(MapFile, RefusesTheColourOfAClassThatItsTableDoesNotList) {
  const ScratchFolder folder;
  folder.put("a.png", written_png(1, 3, {}, kThreeRows));
  folder.put("c.toml",
             "[[class]]\nname = 'pavement'\ncolour = '#d6d2ca'\n[[class]]\nname = 'road'\ncolour = '#787a80'\n");
  EXPECT_EQ(message_of(read_map(folder.put("a.toml", "image = 'a.png'\nresolution_m = 0.5\nclasses = 'c.toml'\n"))),
            folder.path("a.png") +
                ": pixel in column 0, row 1 from the top (0.25 m, 0.75 m) is #94c070, the colour of no class; expected "
                "colours of the class table, the nearest is road #787a80");
}

// The same ground as a photograph of `width` x `height` pixels, whatever it shows.
std::string aerial(std::uint32_t width, std::uint32_t height) {
  return written_png(width, height, {}, std::vector<std::uint8_t>(std::size_t{3} * width * height, 77));
}

TEST(MapFile, TakesAnAerialViewAsItIsWhateverItsResolution) {
  for (const auto& [width, height] : {std::pair(1U, 3U), std::pair(100U, 300U), std::pair(100U, 301U)}) {
    const ScratchFolder folder;
    folder.put("a.png", written_png(1, 3, {}, kThreeRows));
    const std::string bytes = aerial(width, height);
    folder.put("photo.png", bytes);
    const auto map = read_map(folder.put("a.toml", "image = 'a.png'\nresolution_m = 0.5\naerial = 'photo.png'\n"));
    ASSERT_TRUE(map.ok()) << map.error().message;
    EXPECT_EQ(map.value().aerial_path, folder.path("photo.png"));
    EXPECT_EQ(map.value().aerial, bytes) << "for others to read";
  }
}

TEST(MapFile, OneWithoutAnAerialViewHasNone) {
  const ScratchFolder folder;
  folder.put("a.png", written_png(1, 3, {}, kThreeRows));
  const auto map = read_map(folder.put("a.toml", "image = 'a.png'\nresolution_m = 0.5\n"));
  ASSERT_TRUE(map.ok()) << map.error().message;
  EXPECT_EQ(map.value().aerial, "");
  EXPECT_EQ(map.value().aerial_path, "");
}

TEST(MapFile, RefusesAnAerialViewOfAnotherShapeByItsLine) {
  const ScratchFolder folder;
  folder.put("a.png", written_png(1, 3, {}, kThreeRows));
  folder.put("photo.png", aerial(100, 310));
  EXPECT_EQ(message_of(read_map(folder.put("a.toml", "image = 'a.png'\nresolution_m = 0.5\naerial = 'photo.png'\n"))),
            folder.path("a.toml") + ":3: aerial: " + folder.path("photo.png") +
                ": is 100 x 310 pixels; expected the shape of the map, 1 x 3");
}

TEST(MapFile, RefusesAnAerialViewThatIsNoImageByItsLine) {
  const ScratchFolder folder;
  folder.put("a.png", written_png(1, 3, {}, kThreeRows));
  folder.put("photo.png", "no image");
  const std::string said =
      message_of(read_map(folder.put("a.toml", "aerial = 'photo.png'\nimage = 'a.png'\nresolution_m = 0.5\n")));
  EXPECT_EQ(said.rfind(folder.path("a.toml") + ":1: aerial: " + folder.path("photo.png") + ": ", 0), 0U) << said;
  const std::string missing =
      message_of(read_map(folder.put("a.toml", "aerial = 'none.png'\nimage = 'a.png'\nresolution_m = 0.5\n")));
  EXPECT_EQ(missing.rfind(folder.path("a.toml") + ":1: aerial: " + folder.path("none.png") + ": ", 0), 0U) << missing;
}

TEST(MapFile, NamesTheLineOfAnImageThatCannotBeRead) {
  const ScratchFolder folder;
  EXPECT_EQ(message_of(read_map(folder.put("a.toml", "resolution_m = 0.5\nimage = 'a.png'\n"))),
            folder.path("a.toml") + ":2: image: " + folder.path("a.png") +
                ": cannot be read: No such file or directory; expected a PNG image");
}

TEST(MapFile, RefusesUnknownKeysAndSillyResolutions) {
  const ScratchFolder folder;
  EXPECT_EQ(message_of(read_map(folder.put("a.toml", "image = 'a.png'\nresolution_cm = 5\n"))),
            folder.path("a.toml") + ":2: resolution_cm: unknown; this quantity is given as resolution_m, in metres");
  EXPECT_EQ(message_of(read_map(folder.put("a.toml", "image = 'a.png'\nresolution_m = 0\n"))),
            folder.path("a.toml") + ":2: resolution_m: 0 is out of range; expected 0.001 to 100 (metres a pixel)");
}

TEST(ClassFile, TakesWhatIsLeftOutFromTheBuiltInTable) {
  const ScratchFolder folder;
  const auto file = read_classes(folder.put("c.toml", "[[class]]\nname = 'wall'\ncolour = [9, 9, 9]\n"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  const ClassProperties& wall = file.value().classes[static_cast<std::size_t>(kWall)];
  EXPECT_EQ(wall.colour, (Colour{9, 9, 9}));
  EXPECT_TRUE(wall.obstacle);
  EXPECT_TRUE(wall.occluder);
  EXPECT_TRUE(file.value().listed[static_cast<std::size_t>(kWall)]);
  EXPECT_FALSE(file.value().listed[static_cast<std::size_t>(kRoad)]);
}

TEST(ClassFile, RefusesAClassThatIsNone) {
  EXPECT_EQ(
      complaint_about_classes("[[class]]\nname = 'lava'\ncolour = [1, 2, 3]\n"),
      "c.toml:2: class[0].name: \"lava\" is no class; expected one of pavement, road, crossing, parking, cycle lane, "
      "grass, soil, building, wall, tree, shrub, street furniture, water, stairs");
}

TEST(ClassFile, RefusesAClassTwice) {
  EXPECT_EQ(complaint_about_classes("[[class]]\nname = 'road'\ncolour = [1, 2, 3]\n"
                                    "[[class]]\nname = 'road'\ncolour = [1, 2, 4]\n"),
            "c.toml:5: class[1].name: \"road\" is listed twice; expected each class once");
}

TEST(ClassFile, RefusesTwoClassesOfOneColour) {
  EXPECT_EQ(complaint_about_classes("[[class]]\nname = 'road'\ncolour = [1, 2, 3]\n"
                                    "[[class]]\nname = 'wall'\ncolour = '#010203'\n"),
            "c.toml:6: class[1].colour: #010203 is already the colour of road; expected a colour of its own");
}

TEST(ClassFile, RefusesColoursThatAreNone) {
  for (const std::string colour : {"red", "#12345", "#1234567", "#12345g", "#+12345"}) {
    EXPECT_EQ(complaint_about_classes("[[class]]\nname = 'road'\ncolour = '" + colour + "'\n"),
              "c.toml:3: class[0].colour: \"" + colour + "\" is no colour; expected \"#rrggbb\" or [r, g, b]");
  }
  EXPECT_EQ(complaint_about_classes("[[class]]\nname = 'road'\ncolour = [1, 2, 256]\n"),
            "c.toml:3: class[0].colour[2]: 256 is out of range; expected 0 to 255");
  EXPECT_EQ(complaint_about_classes("[[class]]\nname = 'road'\ncolour = [1, 2]\n"),
            "c.toml:3: class[0].colour: has 2 elements; expected a list of 3 numbers, [r, g, b], or \"#rrggbb\"");
}

TEST(ClassFile, RefusesUnknownAgentKindsAndAnEmptyTable) {
  EXPECT_EQ(complaint_about_classes("[[class]]\nname = 'road'\ncolour = [1, 2, 3]\nrestricted = ['cat']\n"),
            "c.toml:4: class[0].restricted[0]: \"cat\" is unknown; expected \"robot\" or \"person\"");
  EXPECT_EQ(complaint_about_classes("# nothing\n"), "c.toml:1: class: missing; it must be given");
}

TEST(MapFile, ReadsASatelliteMask) {
  const std::string mask = std::filesystem::path(IVO_SOURCE_DIR).parent_path() / "shared/data/dubai/tile1_3.png";
  if (!std::filesystem::exists(mask)) {
    GTEST_SKIP() << "no satellite masks at " << mask;
  }
  const ScratchFolder folder;
  folder.put("classes.toml", R"(
class = [
  { name = "building", colour = [60, 16, 152] },
  { name = "soil", colour = [132, 41, 246] },
  { name = "road", colour = [110, 193, 228] },
  { name = "grass", colour = [254, 221, 58] },
  { name = "water", colour = [226, 169, 41] },
  { name = "pavement", colour = [155, 155, 155] },
]
)");
  const auto map =
      read_map(folder.put("dubai.toml", "image = \"" + mask + "\"\nresolution_m = 0.4\nclasses = \"classes.toml\"\n"));
  ASSERT_TRUE(map.ok()) << map.error().message;
  EXPECT_EQ(map.value().width_px, 797);
  EXPECT_EQ(map.value().height_px, 644);
  // The sea lies in the lower left, sand in the upper left corner.
  EXPECT_EQ(map.value().view().at(200, 644 - 1 - 630), kWater);
  EXPECT_EQ(map.value().view().at(5, 644 - 1 - 5), kSoil);
}

}  // namespace
}  // namespace ivo::firmware
