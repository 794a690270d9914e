#include "firmware/files/picture.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/files/picture_layout.hpp"
#include "firmware/files/picture_style.hpp"
#include "firmware/files/png_file.hpp"
#include "tests/unit/firmware/files/complaint.hpp"
#include "tests/unit/firmware/files/scratch_folder.hpp"

// fontconfig keeps its patterns by relative pointers, which the leak detector cannot follow.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }

namespace ivo::firmware {
namespace {

MapFile plain_map(int width_px, int height_px) {
  MapFile map;
  map.width_px = width_px;
  map.height_px = height_px;
  map.resolution_m = 0.5;
  map.classes = default_class_table();
  map.pixels.assign(static_cast<std::size_t>(width_px * height_px), SemanticClass::kPavement);
  return map;
}

SearchPicture full_picture(const MapFile& map, std::span<const double> mass) {
  SearchPicture picture;
  picture.map = &map;
  picture.mass = mass;
  picture.columns = map.width_px;
  picture.rows = map.height_px;
  picture.cell_m = map.resolution_m;
  picture.agents = {{"IVO", AgentKind::kRobot, {1, 1}, {{1, 1}, {8, 1}, {8, 8}}, {{1, 1}, {4, 1}}, {}},
                    {"Ana", AgentKind::kPerson, {9, 9}, {{9, 9}, {2, 9}}, {}, {{{1, 6}, {5, 6}, {5, 9}}}}};
  picture.object = Point{4, 6};
  picture.find = PicturedFind{1, {3, 7}, 2.5};
  picture.title = "A search";
  picture.figures = "expected time 12 s";
  return picture;
}

bool overlap(const Box& a, const Box& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

TEST(Picture, IsAPngOfTheLayoutsSizeAndTheSameEachTime) {
  const ScratchFolder folder;
  const MapFile map = plain_map(20, 24);
  const std::vector<double> mass(20 * 24, 1.0 / 480);
  const SearchPicture picture = full_picture(map, mass);
  ASSERT_TRUE(write_picture(folder.path("a.png"), picture).ok());
  const auto image = read_colours(folder.path("a.png"));
  ASSERT_TRUE(image.ok()) << image.error().message;
  const PictureLayout layout = lay_out(picture);
  EXPECT_EQ(image.value().width_px, layout.width_px);
  EXPECT_EQ(image.value().height_px, layout.height_px);
  EXPECT_EQ(picture_png(picture).value(), picture_png(picture).value());
}

TEST(Picture, ShowsTheRobotsPlanInRedAndThePersonsInGreen) {
  const ScratchFolder folder;
  const MapFile map = plain_map(20, 24);
  const SearchPicture picture = full_picture(map, {});
  ASSERT_TRUE(write_picture(folder.path("a.png"), picture).ok());
  const auto image = read_colours(folder.path("a.png"));
  ASSERT_TRUE(image.ok()) << image.error().message;
  const PictureLayout layout = lay_out(picture);
  const auto seen_at = [&](Point p) {
    const auto column = static_cast<std::size_t>(layout.map.x + p.x_m * layout.px_per_m);
    const auto row_from_top = static_cast<std::size_t>(layout.map.y + layout.map.height - p.y_m * layout.px_per_m);
    const auto width = static_cast<std::size_t>(image.value().width_px);
    return image.value()
        .pixels[(static_cast<std::size_t>(image.value().height_px) - 1 - row_from_top) * width + column];
  };
  const Colour robot = seen_at({8, 2.1});
  EXPECT_GT(robot.r, robot.g + 80);
  EXPECT_GT(robot.r, robot.b + 80);
  const Colour person = seen_at({6.3, 9});
  EXPECT_GT(person.g, person.r + 40);
  const Colour ground = seen_at({6, 4});
  EXPECT_GT(ground.r, 220);
  EXPECT_GT(ground.g, 220);
}

TEST(Picture, DrawsAMapWithNothingOnIt) {
  const MapFile map = plain_map(3, 2);
  SearchPicture picture;
  picture.map = &map;
  EXPECT_TRUE(picture_png(picture).ok());
}

TEST(Picture, RefusesTextThatIsNotUtf8) {
  const MapFile map = plain_map(3, 2);
  SearchPicture picture;
  picture.map = &map;
  picture.title = "caf\xe9";
  EXPECT_EQ(message_of(write_picture("/nowhere/a.png", picture)),
            "/nowhere/a.png: the picture cannot be drawn: input string not valid UTF-8");
}

TEST(PictureLayout, KeepsMapTitleAndLegendApartOnMapsOfEveryShape) {
  const std::array<int, 2> shapes[] = {{20, 20}, {60, 10}, {10, 60}, {200, 5}, {5, 200}, {23, 20}, {20, 23}, {1, 1}};
  for (const auto& [width, height] : shapes) {
    const MapFile map = plain_map(width, height);
    const std::vector<double> mass(map.pixels.size(), 1.0);
    SearchPicture picture = full_picture(map, mass);
    while (picture.agents.size() < 8) {
      picture.agents.push_back(picture.agents[1]);
    }
    const PictureLayout layout = lay_out(picture);
    EXPECT_LE(layout.width_px, 1600) << width << " x " << height;
    EXPECT_LE(layout.height_px, 1600) << width << " x " << height;
    EXPECT_GE(std::max(layout.width_px, layout.height_px), 899);
    std::vector<Box> boxes = {layout.title, layout.map};
    for (const LegendBlock& block : layout.legend) {
      boxes.push_back(block.box);
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_LE(boxes[i].x + boxes[i].width, layout.width_px) << width << " x " << height << " box " << i;
      EXPECT_LE(boxes[i].y + boxes[i].height, layout.height_px) << width << " x " << height << " box " << i;
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(overlap(boxes[i], boxes[j])) << width << " x " << height << " boxes " << i << " and " << j;
      }
    }
  }
}

TEST(PictureStyle, GivesEveryPersonOfATeamAColourOfItsOwn) {
  std::vector<PicturedAgent> agents(8);
  for (std::size_t i = 1; i < agents.size(); ++i) {
    agents[i].kind = AgentKind::kPerson;
  }
  for (std::size_t i = 0; i < agents.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Tint a = agent_tint(agents, i);
      const Tint b = agent_tint(agents, j);
      EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 0.2) << i << " and " << j;
    }
  }
}

TEST(PictureStyle, ShowsAUniformMapFaintAndAPeakInFull) {
  const std::vector<double> uniform = {0.25, 0.25, 0.25, 0.25};
  EXPECT_DOUBLE_EQ(full_heat_density(uniform, 0.5), 3.0);
  const std::vector<double> peaked = {0.97, 0.01, 0.01, 0.01};
  EXPECT_DOUBLE_EQ(full_heat_density(peaked, 0.5), 0.97 / 0.25);
  EXPECT_EQ(full_heat_density({}, 0.5), 0.0);
  EXPECT_EQ(heat(0.0).alpha, 0.0);
  EXPECT_LT(heat(0.3).alpha, heat(1.0).alpha);
}

TEST(PictureStyle, RoundsLengthsDownToOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_length(9.9), 5.0);
  EXPECT_DOUBLE_EQ(round_length(5.0), 5.0);
  EXPECT_DOUBLE_EQ(round_length(4.9), 2.0);
  EXPECT_DOUBLE_EQ(round_length(0.15), 0.1);
  EXPECT_DOUBLE_EQ(round_length(1500), 1000.0);
}

TEST(PictureStyle, PutsArrowsAlongALineAwayFromItsCorners) {
  const std::vector<Point> line = {{0, 0}, {100, 0}, {100, 50}};
  const std::vector<Mark> marks = arrows_along(line, 40.0, 10.0);
  ASSERT_EQ(marks.size(), 3U);
  EXPECT_EQ(marks[0].at, (Point{20, 0}));
  EXPECT_EQ(marks[1].at, (Point{60, 0}));
  EXPECT_EQ(marks[0].heading_rad, 0.0);
  EXPECT_EQ(marks[2].at, (Point{100, 10}));
  EXPECT_DOUBLE_EQ(marks[2].heading_rad, std::atan2(1, 0));
  for (const Mark& mark : marks) {
    EXPECT_GE(std::hypot(mark.at.x_m - 100, mark.at.y_m), 10.0);
  }
  EXPECT_TRUE(arrows_along({}, 40.0, 10.0).empty());
}

TEST(PictureStyle, MovesATrackAsideAndThinsIt) {
  std::vector<Point> track;
  for (int i = 0; i <= 100; ++i) {
    track.push_back({i * 0.1, 0.0});
  }
  const std::vector<Point> moved = beside_line(track, 2.0, 1.0);
  EXPECT_LT(moved.size(), 12U);
  for (const Point& p : moved) {
    EXPECT_DOUBLE_EQ(p.y_m, -2.0);
  }
}

}  // namespace
}  // namespace ivo::firmware
