#include "planner/world/sight_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "planner/world/visibility.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/swath_cells.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

struct Scene {
  Cells cells;
  Graph graph;
  SightTable sight;
};

Scene& scene() {
  static Scene scene;
  return scene;
}

GraphAgents agents_from(std::initializer_list<Point> starts) {
  GraphAgents agents;
  for (const Point start : starts) {
    GraphAgent agent;
    agent.start = start;
    EXPECT_TRUE(agents.push_back(agent));
  }
  return agents;
}

Refusal build(const DrawnMap& map, double cell_m, double spacing_m, const GraphAgents& agents,
              const SightRadii& radii_m) {
  Scene& s = scene();
  EXPECT_FALSE(s.cells.build(map.view(), cell_m));
  EXPECT_FALSE(s.graph.build(map.view(), {spacing_m, 0.4}, agents));
  return s.sight.build(s.cells, s.graph, radii_m);
}

using SeenCells = std::set<Cell>;
using Points = std::pair<int, int>;  // first and last, both included

// What is seen from a point, tried cell by cell.
void look(Point from, double radius_m, SeenCells& seen) {
  const Cells& cells = scene().cells;
  for (Cell c = 0; c < cells.count(); ++c) {
    if (within_radius(cells, from, c, radius_m) && line_of_sight(cells, from, c)) {
      seen.insert(c);
    }
  }
}

SeenCells cells_of(const SightView& view) {
  SeenCells cells;
  test::for_each_cell(scene().cells, scene().sight, view, [&](Cell c, const Swath&) { cells.insert(c); });
  return cells;
}

// The view's cells by the points, counted along the way, from which they are seen.
std::map<Points, SeenCells> parts_of(const SightView& view, int points) {
  std::map<Points, SeenCells> parts;
  test::for_each_cell(scene().cells, scene().sight, view, [&](Cell c, const Swath& swath) {
    const Points range = view.reversed ? Points{points - swath.last_point, points - swath.first_point}
                                       : Points{swath.first_point, swath.last_point};
    EXPECT_TRUE(parts[range].insert(c).second) << "cell " << c << " twice";
  });
  return parts;
}

TEST(SightTable, AgreesWithALookFromEveryPointOfEveryEdgeBothWays) {
  DrawnMap map(9.0, 7.0, 0.5);
  map.put(kBuilding, 3.0, 3.0, 4.5, 5.0).put(kTree, 6.5, 1.5, 7.0, 2.0).put(kWater, 1.0, 5.5, 2.0, 6.0);
  map.put(kWall, 5.5, 0.0, 6.0, 1.0);
  const int agents = std::min(3, limits::kAgents);
  SightRadii radii_m{1.3, 2.6};
  radii_m[index(agents - 1)] = agents > 2 ? 1.3 : 2.6;
  GraphAgents bodies = agents_from({{1.0, 1.0}, {8.0, 6.0}});
  if (agents > 2) {
    GraphAgent third;
    third.start = {1.0, 4.0};
    ASSERT_TRUE(bodies.push_back(third));
  }
  ASSERT_FALSE(build(map, 0.25, 1.8, bodies, radii_m));
  const Scene& s = scene();
  std::map<Cell, AgentSet> observable;
  int long_edges = 0;
  for (int agent = 0; agent < agents; ++agent) {
    const double radius_m = radii_m[index(agent)];
    const auto observe = [&](const SeenCells& seen) {
      for (const Cell c : seen) {
        observable[c] = static_cast<AgentSet>(observable[c] | agent_bit(agent));
      }
    };
    for (Node n = 0; n < s.graph.nodes(); ++n) {
      SeenCells from_node;
      look(s.graph.position(n), radius_m, from_node);
      ASSERT_EQ(cells_of(s.sight.from_node(agent, n)), from_node);
      observe(from_node);
      for (Edge e = s.graph.first_edge(n); e < s.graph.end_edge(n); ++e) {
        SCOPED_TRACE("agent " + std::to_string(agent) + ", edge " + std::to_string(e));
        const int points = sight_points(s.graph.length_m(e), 0.25);
        ASSERT_EQ(s.sight.points(e), points);
        int next = 0;  // the parts follow each other on the way, and share the point between them
        const std::map<Points, SeenCells> parts = parts_of(s.sight.along_edge(agent, e), points);
        for (const auto& [range, cells] : parts) {
          ASSERT_EQ(range.first, next);
          next = range.second;
          SeenCells seen;
          for (int k = range.first; k <= range.second; ++k) {
            look(sight_point(s.graph.position(n), s.graph.position(s.graph.head(e)), k, points), radius_m, seen);
          }
          ASSERT_EQ(cells, seen) << "points " << range.first << " to " << range.second;
          observe(seen);
        }
        ASSERT_EQ(next, points);
        long_edges += parts.size() > 2 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(long_edges, 20);
  for (Cell c = 0; c < s.cells.count(); ++c) {
    ASSERT_EQ(s.sight.observable_by(c), observable[c]) << "cell " << c;
  }
}

TEST(SightTable, GivesTheSwathsInTheOrderOfTheWayInBothDirections) {
  ASSERT_FALSE(build(DrawnMap(30.0, 3.0, 0.5), 0.25, 10.0, agents_from({{1.5, 1.5}}), {1.0}));
  const Scene& s = scene();
  int swaths = 0;
  for (Edge e = 0; e < s.graph.edges(); ++e) {
    const SightView view = s.sight.along_edge(0, e);
    int last = 0;
    for (std::size_t i = 0; i < view.size(); ++i, ++swaths) {
      const int first_point = view.reversed ? s.sight.points(e) - view.at(i).last_point : view.at(i).first_point;
      ASSERT_GE(first_point, last);
      last = first_point;
    }
  }
  EXPECT_GT(swaths, 4 * s.graph.edges());
}

TEST(SightTable, CountsACellAsObservableOnlyByAgentsThatCanGetToASightOfIt) {
  DrawnMap map(14.0, 5.0, 0.5);
  map.put(kWall, 7.0, 0.0, 7.5, 5.0);
  ASSERT_FALSE(build(map, 0.5, 2.0, agents_from({{1.0, 1.0}, {13.0, 1.0}}), {20.0, 20.0}));
  const Scene& s = scene();
  for (Cell c = 0; c < s.cells.count(); ++c) {
    const double x = s.cells.centre(c).x_m;
    const AgentSet by = x > 7.0 && x < 7.5 ? static_cast<AgentSet>(agent_bit(0) | agent_bit(1))  // its two faces
                                           : agent_bit(x < 7.0 ? 0 : 1);
    ASSERT_EQ(s.sight.observable_by(c), by) << "cell " << c;
  }
}

TEST(SightTable, IsBuiltAnewForAnotherMission) {
  ASSERT_FALSE(build(DrawnMap(9.0, 9.0, 0.5), 0.5, 3.0, agents_from({{1.5, 1.5}, {7.5, 7.5}}), {1.0, 3.0}));
  const int before = scene().sight.words_used();
  ASSERT_FALSE(build(DrawnMap(6.0, 3.0, 0.5), 0.5, 3.0, agents_from({{1.5, 1.5}}), {1.0}));
  EXPECT_LT(scene().sight.words_used(), before);
  EXPECT_EQ(scene().graph.edges(), 2);
  ASSERT_FALSE(build(DrawnMap(9.0, 9.0, 0.5), 0.5, 3.0, agents_from({{1.5, 1.5}, {7.5, 7.5}}), {1.0, 3.0}));
  EXPECT_EQ(scene().sight.words_used(), before);
}

TEST(SightTable, KeepsOneRecordForAgentsOfOneRadius) {
  const DrawnMap map(9.0, 9.0, 0.5);
  const GraphAgents two = agents_from({{1.5, 1.5}, {7.5, 7.5}});
  ASSERT_FALSE(build(map, 0.5, 3.0, two, {2.0, 2.0}));
  const int alike = scene().sight.words_used();
  EXPECT_EQ(scene().sight.layer(0), scene().sight.layer(1));
  ASSERT_FALSE(build(map, 0.5, 3.0, two, {2.0, 2.01}));
  EXPECT_NE(scene().sight.layer(0), scene().sight.layer(1));
  EXPECT_EQ(scene().sight.radius_m(1), 2.01);
  EXPECT_GT(scene().sight.words_used(), 1.8 * alike);
}

TEST(SightTable, RefusesAnEdgeWithMoreSightPointsThanAnEventCanNumber) {
  const Refusal refusal = build(DrawnMap(420.0, 2.0, 0.5), 0.25, 210.0, agents_from({{105.0, 1.0}}), {0.3});
  EXPECT_EQ(refusal.code, RefusalCode::kEdgeTooLong);
  EXPECT_GT(refusal.value, SightTable::kMaxPoint);
  EXPECT_EQ(refusal.limit, SightTable::kMaxPoint);
}

TEST(SightTable, RefusesMoreRowsThanItsCapacityAndSaysHowManyThereWouldBe) {
  if (limits::kSightWords == limits::Desktop::kSightWords) {
    GTEST_SKIP() << "takes minutes to fill";
  }
  // From every node and edge every row of the map is seen, three windows wide.
  const bool large = limits::kNodes > 1000;
  const double side_m = large ? 40.0 : 15.0;
  const Refusal refusal =
      build(DrawnMap(side_m, side_m, 0.5), large ? 0.25 : 0.1, 1.0, agents_from({{0.5, 0.5}}), {100.0});
  EXPECT_EQ(refusal.code, RefusalCode::kSightTableFull);
  const Graph& graph = scene().graph;
  EXPECT_EQ(refusal.value, (graph.nodes() + graph.edges() / 2) * scene().cells.rows() * 3.0);
  EXPECT_GT(refusal.value, limits::kSightWords);
  EXPECT_EQ(refusal.limit, limits::kSightWords);
}

TEST(SightTable, IsBuiltAgainAfterARefusal) {
  ASSERT_TRUE(build(DrawnMap(420.0, 2.0, 0.5), 0.25, 210.0, agents_from({{105.0, 1.0}}), {0.3}));
  ASSERT_FALSE(build(DrawnMap(3.0, 3.0, 0.5), 0.5, 3.0, agents_from({{1.5, 1.5}}), {1.0}));
  SeenCells seen;
  look({1.5, 1.5}, 1.0, seen);
  EXPECT_EQ(cells_of(scene().sight.from_node(0, 0)), seen);
}

}  // namespace
}  // namespace ivo::planner
