#include "planner/search/edge_events.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <vector>

#include "planner/world/visibility.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

constexpr int kAllAtOnce = std::numeric_limits<int>::max();

struct Scene {
  Cells cells;
  Graph graph;
  SightTable sight;
  EdgeEvents events{cells, graph, sight};
  EdgeEvents little{cells, graph, sight, 3000};  // a handful of edges
};

Scene& scene() {
  static Scene scene;
  return scene;
}

void build(const DrawnMap& map, double cell_m, double spacing_m, std::initializer_list<Point> starts,
           const SightRadii& radii_m) {
  Scene& s = scene();
  GraphAgents agents;
  for (const Point start : starts) {
    GraphAgent agent;
    agent.start = start;
    ASSERT_TRUE(agents.push_back(agent));
  }
  ASSERT_FALSE(s.cells.build(map.view(), cell_m));
  ASSERT_FALSE(s.graph.build(map.view(), {spacing_m, 0.4}, agents));
  ASSERT_FALSE(s.sight.build(s.cells, s.graph, radii_m));
  s.events.clear();
  s.little.clear();
}

DrawnMap with_things() {
  DrawnMap map(9.0, 7.0, 0.5);
  map.put(kBuilding, 3.0, 3.0, 4.5, 5.0).put(kTree, 6.5, 1.5, 7.0, 2.0).put(kWater, 1.0, 5.5, 2.0, 6.0);
  map.put(kWall, 5.5, 0.0, 6.0, 1.0);
  return map;
}

using FirstPoints = std::map<Cell, int>;

// The first sight point of the edge that sees each cell, tried cell by cell and point by point; without what the tail
// sees.
FirstPoints slow_first_points(Node tail, Edge e, double radius_m) {
  const Scene& s = scene();
  FirstPoints first;
  const Point a = s.graph.position(tail);
  const Point b = s.graph.position(s.graph.head(e));
  const int n = sight_points(s.graph.length_m(e), s.cells.cell_m());
  for (Cell c = 0; c < s.cells.count(); ++c) {
    for (int k = 0; k <= n; ++k) {
      const Point p = sight_point(a, b, k, n);
      if (within_radius(s.cells, p, c, radius_m) && line_of_sight(s.cells, p, c)) {
        if (k > 0) {
          first.emplace(c, k);
        }
        break;
      }
    }
  }
  return first;
}

FirstPoints as_map(std::span<const SightEvent> events) {
  FirstPoints first;
  for (const SightEvent event : events) {
    EXPECT_TRUE(first.emplace(event.cell(), event.point()).second) << "cell " << event.cell() << " twice";
  }
  return first;
}

FirstPoints prepared(EdgeEvents& events, int agent, Node tail, Edge e, int rows = kAllAtOnce) {
  while (!events.ready(agent, e)) {
    EXPECT_GT(events.prepare(agent, tail, e, rows), 0);
  }
  EXPECT_EQ(events.prepare(agent, tail, e, rows), 0);
  return as_map(events.along(agent, e));
}

struct Directed {
  Node tail;
  Edge e;
};

std::vector<Directed> all_edges() {
  std::vector<Directed> edges;
  for (Node n = 0; n < scene().graph.nodes(); ++n) {
    for (Edge e = scene().graph.first_edge(n); e < scene().graph.end_edge(n); ++e) {
      edges.push_back({n, e});
    }
  }
  return edges;
}

TEST(SightEvent, KeepsCellAndPointAtTheirLargest) {
  const SightEvent event(limits::kCells - 1, SightTable::kMaxPoint);
  EXPECT_EQ(event.cell(), limits::kCells - 1);
  EXPECT_EQ(event.point(), SightTable::kMaxPoint);
  EXPECT_EQ(SightEvent(0, 5).cell(), 0);
  EXPECT_EQ(SightEvent(0, 5).point(), 5);
}

TEST(EdgeEvents, AgreeWithALookFromEveryPointOfEveryEdgeBothWays) {
  for (const double cell_m : {0.5, 0.25}) {
    const SightRadii radii_m = {1.3, 2.6};
    ASSERT_NO_FATAL_FAILURE(build(with_things(), cell_m, 1.8, {{1.0, 1.0}, {8.0, 6.0}}, radii_m));
    int reversed = 0;
    for (int agent = 0; agent < 2; ++agent) {
      for (const auto& [tail, e] : all_edges()) {
        ASSERT_EQ(prepared(scene().events, agent, tail, e), slow_first_points(tail, e, radii_m[index(agent)]))
            << "agent " << agent << ", node " << tail << ", edge " << e;
        reversed += scene().sight.along_edge(agent, e).reversed ? 1 : 0;
      }
    }
    EXPECT_EQ(reversed, scene().graph.edges());  // each edge once for each agent
  }
}

TEST(EdgeEvents, AgreeWithALookOnRandomMaps) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> x(0.0, 9.0);
  std::uniform_real_distribution<double> y(0.0, 7.0);
  std::uniform_real_distribution<double> size(0.2, 1.5);
  constexpr std::array<SemanticClass, 3> kThings = {kBuilding, kTree, kWater};
  for (int i = 0; i < 12; ++i) {
    DrawnMap map(9.0, 7.0, 0.25);
    for (int k = 0; k < 5; ++k) {
      const Point p{x(random), y(random)};
      map.put(kThings[random() % 3], p.x_m, p.y_m, p.x_m + size(random), p.y_m + size(random));
    }
    map.put(kPavement, 0.0, 0.0, 2.0, 2.0);
    const double radius_m = 0.5 + size(random);
    ASSERT_NO_FATAL_FAILURE(build(map, i % 2 == 0 ? 0.25 : 0.3, 1.5, {{1.0, 1.0}}, {radius_m}));
    const std::vector<Directed> edges = all_edges();
    for (int k = 0; k < 40; ++k) {
      const auto [tail, e] = edges[random() % edges.size()];
      if (scene().graph.open_to(e) != 0) {
        ASSERT_EQ(prepared(scene().events, 0, tail, e), slow_first_points(tail, e, radius_m)) << "map " << i;
      }
    }
  }
}

TEST(EdgeEvents, AreTheSameWhenMadeInManySmallParts) {
  ASSERT_NO_FATAL_FAILURE(build(with_things(), 0.25, 1.8, {{1.0, 1.0}, {8.0, 6.0}}, {1.3, 2.6}));
  for (const auto& [tail, e] : all_edges()) {
    const FirstPoints at_once = prepared(scene().events, 1, tail, e);
    ASSERT_EQ(prepared(scene().little, 1, tail, e, 1 + e % 9), at_once);
  }
}

TEST(EdgeEvents, AreTheSameWhereOnlyAFewEdgesCanBeKept) {
  ASSERT_NO_FATAL_FAILURE(build(with_things(), 0.25, 1.8, {{1.0, 1.0}, {8.0, 6.0}}, {1.3, 2.6}));
  const std::vector<Directed> edges = all_edges();
  std::mt19937_64 random(42);
  int made_again = 0;
  int kept = 0;
  for (int i = 0; i < 4000; ++i) {
    // Some edges often, as in a search.
    const auto [tail, e] = edges[random() % (i % 2 == 0 ? 4 : edges.size())];
    const int agent = static_cast<int>(random() % 2);
    const bool ready = scene().little.ready(agent, e);
    ++(ready ? kept : made_again);
    ASSERT_EQ(prepared(scene().little, agent, tail, e), prepared(scene().events, agent, tail, e)) << "look-up " << i;
  }
  EXPECT_GT(made_again, 2000);
  EXPECT_GT(kept, 50);
}

TEST(EdgeEvents, AreTheSameAfterAnotherEdgeWasLeftHalfMade) {
  ASSERT_NO_FATAL_FAILURE(build(with_things(), 0.25, 1.8, {{1.0, 1.0}, {8.0, 6.0}}, {1.3, 2.6}));
  const std::vector<Directed> edges = all_edges();
  std::mt19937_64 random(43);
  for (int i = 0; i < 600; ++i) {
    const auto [half_tail, half] = edges[random() % edges.size()];
    (void)scene().little.prepare(1, half_tail, half, 1 + static_cast<int>(random() % 20));
    const auto [tail, e] = edges[random() % edges.size()];
    ASSERT_EQ(prepared(scene().little, 0, tail, e), prepared(scene().events, 0, tail, e)) << "look-up " << i;
  }
}

TEST(EdgeEvents, AreForgottenWithTheMission) {
  ASSERT_NO_FATAL_FAILURE(build(with_things(), 0.5, 1.8, {{1.0, 1.0}}, {2.6}));
  (void)prepared(scene().events, 0, 0, 0);
  EXPECT_TRUE(scene().events.ready(0, 0));
  scene().events.clear();
  EXPECT_FALSE(scene().events.ready(0, 0));
}

TEST(EdgeEvents, OfAPieceOfWorkDoAboutAsManyRowsAsAsked) {
  ASSERT_NO_FATAL_FAILURE(build(with_things(), 0.25, 1.8, {{1.0, 1.0}}, {2.6}));
  // A row costs two units at least: ten units are five rows and the one that goes over.
  for (const auto& [tail, e] : all_edges()) {
    int rows = 0;
    for (const Swath& swath : scene().sight.along_edge(0, e).swaths) {
      rows += swath.rows;
    }
    int calls = 0;
    for (; !scene().events.ready(0, e); ++calls) {
      ASSERT_GT(scene().events.prepare(0, tail, e, 10), 0);
    }
    EXPECT_GE(calls, rows / 6);
  }
}

}  // namespace
}  // namespace ivo::planner
