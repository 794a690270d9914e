#include "firmware/files/picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/files/picture_layout.hpp"
#include "firmware/files/picture_style.hpp"
#include "firmware/files/png_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"

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
  picture.agents = {{"IVO", AgentKind::kRobot, {1, 1}, {{1, 1}, {8, 1}, {8, 8}}, {{1, 1}, {4, 1}}, {}, {}},
                    {"Ana", AgentKind::kPerson, {9, 9}, {{9, 9}, {2, 9}}, {}, {{{1, 6}, {5, 6}, {5, 9}}}, {}}};
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

/// What a reader of the picture sees, by place on the map.
class Seen {
 public:
  explicit Seen(const SearchPicture& picture) : layout_(lay_out(picture)) {
    const ScratchFolder folder;
    EXPECT_TRUE(write_picture(folder.path("a.png"), picture).ok());
    auto image = read_colours(folder.path("a.png"));
    EXPECT_TRUE(image.ok());
    image_ = std::move(image).value();
  }

  /// Some pixels off to the right and up.
  [[nodiscard]] Colour at(Point p, double right_px = 0.0, double up_px = 0.0) const {
    const auto column = static_cast<std::size_t>(layout_.map.x + p.x_m * layout_.px_per_m + right_px);
    const auto row_from_top =
        static_cast<std::size_t>(layout_.map.y + layout_.map.height - p.y_m * layout_.px_per_m - up_px);
    const auto width = static_cast<std::size_t>(image_.width_px);
    return image_.pixels[(static_cast<std::size_t>(image_.height_px) - 1 - row_from_top) * width + column];
  }

  /// Among the pixels of a square about the place.
  template <class Is>
  [[nodiscard]] int count(Point p, int reach_px, Is is) const {
    int found = 0;
    for (int right = -reach_px; right <= reach_px; ++right) {
      for (int up = -reach_px; up <= reach_px; ++up) {
        found += is(at(p, right, up)) ? 1 : 0;
      }
    }
    return found;
  }

 private:
  PictureLayout layout_;
  ColourImage image_;
};

bool is_red(Colour c) { return c.r > c.g + 80 && c.r > c.b + 80; }
bool is_green(Colour c) { return c.g > c.r + 40 && c.g > c.b + 25; }
bool is_ground(Colour c) {
  const Tint ground = calm_palette()[static_cast<std::size_t>(SemanticClass::kPavement)];
  return std::abs(c.r - 255 * ground.r) < 2 && std::abs(c.g - 255 * ground.g) < 2 && std::abs(c.b - 255 * ground.b) < 2;
}
bool is_other(Colour c) { return !is_ground(c); }

bool says(const SearchPicture& picture, const std::string& text) {
  const PictureLayout layout = lay_out(picture);
  return std::any_of(layout.legend.begin(), layout.legend.end(), [&](const LegendBlock& block) {
    return std::any_of(block.rows.begin(), block.rows.end(), [&](const LegendRow& row) { return row.text == text; });
  });
}

TEST(Picture, ShowsTheRobotsPlanInRedAndThePersonsInGreen) {
  const MapFile map = plain_map(20, 24);
  const Seen seen(full_picture(map, {}));
  EXPECT_TRUE(is_red(seen.at({8, 2.1})));
  EXPECT_GT(seen.count({6.3, 9}, 5, is_green), 20);
  EXPECT_TRUE(is_ground(seen.at({6, 4})));
}

TEST(Picture, KeepsThePlansApartFromTheHeatAtItsFullest) {
  const MapFile map = plain_map(20, 24);
  std::vector<double> mass(20 * 24, 1e-9);
  std::fill_n(mass.begin(), 200, 0.005);
  const Seen seen(full_picture(map, mass));
  const Colour heat = seen.at({6, 2.5});
  EXPECT_GT(heat.b, heat.g + 60);
  EXPECT_FALSE(is_red(heat));
  EXPECT_TRUE(is_red(seen.at({8, 2.1})));
}

TEST(Picture, SaysThatAUniformPriorIsAlikeEverywhereAndLeavesTheGroundItsColour) {
  const MapFile map = plain_map(20, 24);
  const std::vector<double> mass(20 * 24, 1.0 / 480);
  SearchPicture picture = full_picture(map, mass);
  EXPECT_TRUE(is_other(Seen(picture).at({6, 4})));
  EXPECT_FALSE(says(picture, "everywhere alike"));
  picture.alike = true;
  EXPECT_TRUE(is_ground(Seen(picture).at({6, 4})));
  EXPECT_TRUE(says(picture, "everywhere alike"));
}

TEST(Picture, HatchesWhatIsOutOfSight) {
  const MapFile map = plain_map(20, 24);
  const std::vector<double> mass(20 * 24, 1.0 / 480);
  SearchPicture picture = full_picture(map, mass);
  picture.alike = true;
  EXPECT_FALSE(says(picture, "out of sight"));
  picture.out_of_sight.assign(mass.size(), false);
  EXPECT_FALSE(says(picture, "out of sight"));
  picture.out_of_sight[8 * 20 + 12] = true;  // 6 to 6.5 m, 4 to 4.5 m
  EXPECT_TRUE(says(picture, "out of sight"));
  const Seen seen(picture);
  EXPECT_GT(seen.count({6.25, 4.25}, 8, is_other), 20);
  EXPECT_EQ(seen.count({6.75, 4.25}, 8, is_other), 0);
}

TEST(Picture, HatchesARestrictedAreaInItsAgentsColour) {
  const MapFile map = plain_map(20, 24);
  SearchPicture picture = full_picture(map, {});
  EXPECT_FALSE(says(picture, "restricted area"));
  EXPECT_EQ(Seen(picture).count({6, 4}, 15, is_other), 0);
  picture.agents[0].restricted = {{{5, 3}, {7, 3}, {7, 5}, {5, 5}}};
  EXPECT_TRUE(says(picture, "restricted area"));
  const Seen seen(picture);
  const auto reddish = [](Colour c) { return c.r > c.g + 40; };
  EXPECT_GT(seen.count({6, 4}, 15, reddish), 60);
  EXPECT_TRUE(is_red(seen.at({5, 4})));
}

TEST(Picture, ShowsBothPlansWhereTwoAgentsShareAWay) {
  const MapFile map = plain_map(20, 24);
  SearchPicture picture = full_picture(map, {});
  for (const std::vector<Point>& way : {std::vector<Point>{{2, 3}, {7, 3}}, std::vector<Point>{{7, 3}, {2, 3}}}) {
    picture.agents[0].plan = {{2, 3}, {7, 3}};
    picture.agents[1].plan = way;
    const Seen seen(picture);
    EXPECT_GT(seen.count({3, 3}, 9, is_red), 30);
    EXPECT_GT(seen.count({3, 3}, 9, is_green), 30);
  }
}

TEST(Picture, MarksWhereAnAgentThatDidNotFindItStandsAtTheEnd) {
  const MapFile map = plain_map(20, 24);
  SearchPicture picture = full_picture(map, {});
  picture.agents[0].track = {{1, 1}, {4, 1}, {4, 3}};
  EXPECT_TRUE(says(picture, "IVO at the end"));
  EXPECT_TRUE(is_red(Seen(picture).at({4, 3}, 6.0)));
  picture.agents[1].track = {{9, 9}, {8, 9}};
  EXPECT_TRUE(says(picture, "IVO at the end"));
  picture.find.reset();
  EXPECT_TRUE(says(picture, "at the end"));
  picture.find = PicturedFind{0, {4, 3}, 2.5};
  EXPECT_TRUE(says(picture, "Ana at the end"));
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

TEST(PictureStyle, ShowsAnEvenPriorFaintAndAPeakInFull) {
  const std::vector<double> even = {0.25, 0.25, 0.25, 0.25};
  EXPECT_DOUBLE_EQ(full_heat_density(even, 0.5), 3.0);
  const std::vector<double> peaked = {0.97, 0.01, 0.01, 0.01};
  EXPECT_DOUBLE_EQ(full_heat_density(peaked, 0.5), 0.97 / 0.25);
  EXPECT_EQ(full_heat_density({}, 0.5), 0.0);
  EXPECT_EQ(heat(0.0).alpha, 0.0);
  EXPECT_LT(heat(0.3).alpha, heat(1.0).alpha);
}

TEST(PictureStyle, TakesTheDensityBelowWhichNearlyAllMassLies) {
  std::vector<double> mass(1000, 0.00099);
  mass.push_back(0.01);
  EXPECT_NEAR(full_heat_density(mass, 1.0), 3.0 / 1001, 1e-12);
  std::vector<double> graded;
  for (int i = 1; i <= 1000; ++i) {
    graded.push_back(std::pow(i / 1000.0, 8.0));
  }
  // Of a density u^8 with u even, the share u^9 lies below.
  EXPECT_NEAR(full_heat_density(graded, 1.0), std::pow(0.98, 8.0 / 9.0), 0.01);
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

TEST(PictureStyle, KeepsItsDistanceFromALineRoundCornersAndBack) {
  const std::vector<Point> corner = {{0, 0}, {10, 0}, {10, 0}, {10, 10}};
  const std::vector<Point> aside = beside_line(corner, 2.0, 0.0);
  ASSERT_EQ(aside.size(), 3U);
  EXPECT_EQ(aside[0], (Point{0, -2}));
  EXPECT_EQ(aside[1], (Point{12, -2}));
  EXPECT_EQ(aside[2], (Point{12, 10}));
  const std::vector<Point> there_and_back = {{0, 0}, {10, 0}, {0, 0}};
  const std::vector<Point> both = beside_line(there_and_back, 2.0, 0.0);
  ASSERT_EQ(both.size(), 4U);
  EXPECT_EQ(both[1], (Point{10, -2}));
  EXPECT_EQ(both[2], (Point{10, 2}));
  EXPECT_TRUE(beside_line({}, 2.0, 0.0).empty());
}

}  // namespace
}  // namespace ivo::firmware
