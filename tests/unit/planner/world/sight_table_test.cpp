#include "planner/world/sight_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

#include "planner/world/visibility.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

struct Scene {
  Cells cells;
  Graph graph;
  SightTable sight;
  std::vector<double> mass;
};

Scene& scene() {
  static Scene scene;
  return scene;
}

GraphAgents agents_at(std::initializer_list<Point> starts) {
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
  s.mass.assign(static_cast<std::size_t>(s.cells.count()), 1.0);
  for (Cell c = 0; c < s.cells.count(); ++c) {
    if (s.cells.obstacle(c) || c % 7 == 0) {
      s.mass[static_cast<std::size_t>(c)] = 0.0;
    }
  }
  return s.sight.build(s.cells, s.graph, radii_m, s.mass);
}

using FirstPoints = std::map<Cell, int>;

// The first sight point of the edge that sees each cell with mass, tried cell by cell and point by point.
FirstPoints slow_first_points(Node tail, Edge e, double radius_m) {
  const Scene& s = scene();
  FirstPoints first;
  const Point a = s.graph.position(tail);
  const Point b = s.graph.position(s.graph.head(e));
  const int n = sight_points(s.graph.length_m(e), s.cells.cell_m());
  for (Cell c = 0; c < s.cells.count(); ++c) {
    for (int k = 0; k <= n && s.mass[static_cast<std::size_t>(c)] > 0.0; ++k) {
      const Point p = sight_point(a, b, k, n);
      if (within_radius(s.cells, p, c, radius_m) && line_of_sight(s.cells, p, c)) {
        first.emplace(c, k);
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

TEST(SightEvent, KeepsCellAndPointAtTheirLargest) {
  const SightEvent event(limits::kCells - 1, SightEvent::kMaxPoint);
  EXPECT_EQ(event.cell(), limits::kCells - 1);
  EXPECT_EQ(event.point(), SightEvent::kMaxPoint);
  EXPECT_EQ(SightEvent(0, 5).cell(), 0);
  EXPECT_EQ(SightEvent(0, 5).point(), 5);
}

TEST(SightTable, AgreesWithALookFromEveryPointOfEveryEdgeBothWays) {
  DrawnMap map(9.0, 7.0, 0.5);
  map.put(kBuilding, 3.0, 3.0, 4.5, 5.0).put(kTree, 6.5, 1.5, 7.0, 2.0).put(kWater, 1.0, 5.5, 2.0, 6.0);
  map.put(kWall, 5.5, 0.0, 6.0, 1.0);
  const SightRadii radii_m = {1.3, 2.6, 1.3};
  ASSERT_FALSE(build(map, 0.5, 1.8, agents_at({{1.0, 1.0}, {8.0, 6.0}, {1.0, 4.0}}), radii_m));
  const Scene& s = scene();
  std::map<Cell, AgentSet> observable;
  for (int agent = 0; agent < 3; ++agent) {
    const double radius_m = radii_m[static_cast<std::size_t>(agent)];
    for (Node n = 0; n < s.graph.nodes(); ++n) {
      FirstPoints from_node;
      for (Cell c = 0; c < s.cells.count(); ++c) {
        if (s.mass[static_cast<std::size_t>(c)] > 0.0 && within_radius(s.cells, s.graph.position(n), c, radius_m) &&
            line_of_sight(s.cells, s.graph.position(n), c)) {
          from_node.emplace(c, 0);
          observable[c] = static_cast<AgentSet>(observable[c] | agent_bit(agent));
        }
      }
      ASSERT_EQ(as_map(s.sight.from_node(agent, n)), from_node);
      for (Edge e = s.graph.first_edge(n); e < s.graph.end_edge(n); ++e) {
        FirstPoints first = slow_first_points(n, e, radius_m);
        for (const auto& [cell, point] : first) {
          observable[cell] = static_cast<AgentSet>(observable[cell] | agent_bit(agent));
        }
        std::erase_if(first, [](const auto& entry) { return entry.second == 0; });
        ASSERT_EQ(as_map(s.sight.along_edge(agent, e)), first) << "agent " << agent << ", node " << n << ", edge " << e;
        ASSERT_EQ(s.sight.points(e), sight_points(s.graph.length_m(e), 0.5));
      }
    }
  }
  for (Cell c = 0; c < s.cells.count(); ++c) {
    ASSERT_EQ(s.sight.observable_by(c), observable[c]) << "cell " << c;
  }
}

TEST(SightTable, CountsACellAsObservableOnlyByAgentsThatCanGetToASightOfIt) {
  DrawnMap map(14.0, 5.0, 0.5);
  map.put(kWall, 7.0, 0.0, 7.5, 5.0);
  ASSERT_FALSE(build(map, 0.5, 2.0, agents_at({{1.0, 1.0}, {13.0, 1.0}}), {20.0, 20.0}));
  const Scene& s = scene();
  for (Cell c = 0; c < s.cells.count(); ++c) {
    const double x = s.cells.centre(c).x_m;
    const bool has_mass = s.mass[static_cast<std::size_t>(c)] > 0.0;
    ASSERT_EQ(s.sight.observable_by(c), has_mass ? agent_bit(x < 7.0 ? 0 : 1) : 0) << "cell " << c;
  }
}

TEST(SightTable, IsBuiltAnewForAnotherMission) {
  ASSERT_FALSE(build(DrawnMap(9.0, 9.0, 0.5), 0.5, 3.0, agents_at({{1.5, 1.5}, {7.5, 7.5}}), {1.0, 3.0}));
  const int before = scene().sight.events();
  ASSERT_FALSE(build(DrawnMap(6.0, 3.0, 0.5), 0.5, 3.0, agents_at({{1.5, 1.5}}), {1.0}));
  EXPECT_LT(scene().sight.events(), before);
  EXPECT_EQ(scene().graph.edges(), 2);
  ASSERT_FALSE(build(DrawnMap(9.0, 9.0, 0.5), 0.5, 3.0, agents_at({{1.5, 1.5}, {7.5, 7.5}}), {1.0, 3.0}));
  EXPECT_EQ(scene().sight.events(), before);
}

TEST(SightTable, RefusesAnEdgeWithMoreSightPointsThanAnEventCanNumber) {
  const Refusal refusal = build(DrawnMap(420.0, 2.0, 0.5), 0.05, 105.0, agents_at({{52.5, 1.0}}), {0.3});
  EXPECT_EQ(refusal.code, RefusalCode::kEdgeTooLong);
  EXPECT_GT(refusal.value, SightEvent::kMaxPoint);
  EXPECT_EQ(refusal.limit, SightEvent::kMaxPoint);
}

TEST(SightTable, RefusesMoreEventsThanItsCapacity) {
  // Every node sees every cell: the nodes' own rows alone are too many.
  const Refusal refusal = build(DrawnMap(60.0, 60.0, 0.5), 0.5, 1.0, agents_at({{0.5, 0.5}}), {100.0});
  EXPECT_EQ(refusal.code, RefusalCode::kSightTableFull);
  EXPECT_EQ(refusal.value, limits::kSightEvents);
  EXPECT_EQ(refusal.limit, limits::kSightEvents);
}

}  // namespace
}  // namespace ivo::planner
