#include "planner/world/graph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/world/collision.hpp"
#include "tests/support/areas.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

GraphAgents agents_at(std::initializer_list<Point> starts) {
  GraphAgents agents;
  for (const Point start : starts) {
    GraphAgent agent;
    agent.start = start;
    EXPECT_TRUE(agents.push_back(agent));
  }
  return agents;
}

Graph& graph_of(const DrawnMap& map, const GraphParameters& parameters, const GraphAgents& agents) {
  static Graph graph;
  EXPECT_EQ(graph.build(map.view(), parameters, agents).code, RefusalCode::kNone);
  return graph;
}

Node node_at(const Graph& graph, Point p) {
  for (Node n = 0; n < graph.nodes(); ++n) {
    if (std::hypot(graph.position(n).x_m - p.x_m, graph.position(n).y_m - p.y_m) < 1e-9) {
      return n;
    }
  }
  return -1;
}

int degree(const Graph& graph, Node n) { return graph.end_edge(n) - graph.first_edge(n); }

TEST(Graph, OfFortyMetresAtThreeAndAHalfHasTwelveByTwelveSquares) {
  const Graph& graph = graph_of(DrawnMap(40.0, 40.0, 0.25), {}, agents_at({{1.75, 1.75}}));
  EXPECT_EQ(graph.nodes(), 144);
  EXPECT_EQ(graph.position(0), (Point{1.75, 1.75}));
  EXPECT_GE(node_at(graph, {19.25, 5.25}), 0);
  EXPECT_GE(node_at(graph, {39.25, 1.75}), 0);  // cut by the border: 38.5 to 40
  EXPECT_GE(node_at(graph, {39.25, 39.25}), 0);
}

TEST(Graph, ThatDividesTheMapHasNoCutSquares) {
  EXPECT_EQ(graph_of(DrawnMap(10.0, 7.5, 0.5), {2.5, 0.4}, agents_at({{1.25, 1.25}})).nodes(), 12);
  EXPECT_EQ(graph_of(DrawnMap(6.3, 2.1, 0.1), {2.1, 0.4}, agents_at({{1.05, 1.05}})).nodes(), 3);
}

TEST(Graph, JoinsEachNodeWithTheSevenBySevenSquaresAroundIt) {
  const Graph& graph = graph_of(DrawnMap(40.0, 40.0, 0.25), {}, agents_at({{1.75, 1.75}}));
  EXPECT_EQ(degree(graph, 0), 15);
  EXPECT_EQ(degree(graph, node_at(graph, {19.25, 1.75})), 27);
  EXPECT_EQ(degree(graph, node_at(graph, {19.25, 19.25})), 48);
  EXPECT_EQ(degree(graph, node_at(graph, {5.25, 8.75})), 5 * 6 - 1);
  EXPECT_EQ(graph.edges(), 72 * 72 - 144);  // a row has 72 pairs within three squares, itself counted
}

TEST(Graph, HasEveryEdgeInBothDirections) {
  DrawnMap map(20.0, 20.0, 0.25);
  map.put(kBuilding, 6.0, 6.0, 11.0, 9.0).put(kStairs, 12.0, 0.0, 13.0, 12.0);
  GraphAgents agents = agents_at({{2.0, 2.0}, {17.0, 3.0}});
  agents[1].kind = AgentKind::kPerson;
  const Graph& graph = graph_of(map, {2.5, 0.4}, agents);
  for (Node n = 0; n < graph.nodes(); ++n) {
    for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
      const Edge back = graph.find(graph.head(e), n);
      ASSERT_GE(back, 0);
      ASSERT_EQ(graph.head(back), n);
      ASSERT_EQ(graph.length_m(back), graph.length_m(e));
      ASSERT_EQ(graph.open_to(back), graph.open_to(e));
      ASSERT_EQ(graph.find(n, graph.head(e)), e);
    }
    ASSERT_EQ(graph.find(n, n), -1);
  }
}

TEST(Graph, HasAnEdgeExactlyWhereTheFootprintPasses) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int edges = 0;
  int blocked = 0;
  for (int i = 0; i < 8; ++i) {
    DrawnMap map(16.0, 12.0, 0.25);
    for (int k = 0; k < 6; ++k) {
      const double x = 3.0 + 12.0 * unit(random);
      const double y = 2.5 + 8.0 * unit(random);
      map.put(k % 2 == 0 ? kWall : kWater, x, y, x + 0.3 + unit(random), y + 0.3 + unit(random));
    }
    const Graph& graph = graph_of(map, {2.0, 0.4}, agents_at({{1.0, 1.0}}));
    const auto square = [](double v) { return static_cast<int>(v / 2.0); };
    const ClassSet obstacles = obstacle_classes(default_class_table());
    for (Node a = 1; a < graph.nodes(); ++a) {
      for (Node b = 1; b < a; ++b) {
        const Point p = graph.position(a);
        const Point q = graph.position(b);
        const auto on_a_side = [](Point c) { return std::fmod(c.x_m, 2.0) == 0.0 || std::fmod(c.y_m, 2.0) == 0.0; };
        if (on_a_side(p) || on_a_side(q)) {
          continue;  // a corner does not tell whose node it is
        }
        const bool near = std::abs(square(p.x_m) - square(q.x_m)) <= 3 && std::abs(square(p.y_m) - square(q.y_m)) <= 3;
        const bool free = near && swept_disc_is_free(map.view(), obstacles, p, q, 0.30);
        edges += free ? 1 : 0;
        blocked += near && !free ? 1 : 0;
        const Edge e = graph.find(a, b);
        if (e >= 0) {
          ASSERT_TRUE(free) << a << " to " << b;
          ASSERT_DOUBLE_EQ(graph.length_m(e), std::hypot(p.x_m - q.x_m, p.y_m - q.y_m));
        } else {
          ASSERT_FALSE(free) << a << " to " << b;
        }
      }
    }
  }
  EXPECT_GT(edges, 1000);
  EXPECT_GT(blocked, 1000);
}

TEST(Graph, DropsANodeCloserThanAQuarterOfTheSpacingToAStart) {
  const DrawnMap map(40.0, 40.0, 0.25);
  EXPECT_EQ(graph_of(map, {}, agents_at({{5.25 + 0.87, 5.25}})).nodes(), 144);
  EXPECT_EQ(graph_of(map, {}, agents_at({{5.25 + 0.88, 5.25}})).nodes(), 145);
  EXPECT_EQ(graph_of(map, {}, agents_at({{5.25 + 0.875, 5.25}})).nodes(), 145);  // exactly h/4 is not closer
  EXPECT_EQ(node_at(graph_of(map, {}, agents_at({{5.25 + 0.87, 5.25}})), {5.25, 5.25}), -1);
}

// In two squares, things in the middle send their nodes to one corner.
TEST(Graph, DropsANodeOnAnEarlierNodeAndLetsItsSquarePointThere) {
  DrawnMap map(40.0, 12.0, 0.25);
  // Square (4, 1), 16 to 20 by 4 to 8: blocked in the middle, free area leaning to the lower left corner (16, 4).
  map.put(kWater, 17.5, 5.5, 20.0, 8.0);
  map.put(kWater, 17.25, 5.0, 17.5, 5.5).put(kWater, 16.5, 5.25, 17.25, 5.75);
  // Square (3, 0), 12 to 16 by 0 to 4: its clear corner nearest to the free area is (16, 4) too.
  map.put(kWater, 12.0, 0.0, 14.75, 2.75).put(kWater, 14.75, 2.0, 15.25, 2.5);
  const Graph& graph = graph_of(map, {4.0, 0.4}, agents_at({{2.0, 2.0}}));
  const Node corner = node_at(graph, {16.0, 4.0});
  ASSERT_GE(corner, 0);
  EXPECT_EQ(graph.nodes(), 30 - 1);
  // Columns 0 to 6 from square 3, 1 to 7 from square 4.
  EXPECT_GE(graph.find(corner, node_at(graph, {2.0, 6.0})), 0);
  EXPECT_GE(graph.find(corner, node_at(graph, {30.0, 2.0})), 0);
  EXPECT_EQ(graph.find(corner, node_at(graph, {34.0, 2.0})), -1);
}

TEST(Graph, GivesAStartTheNeighbourhoodOfItsOwnSquareAndOfThoseThatPointToIt) {
  DrawnMap map(40.0, 8.0, 0.25);
  map.put(kWater, 17.5, 1.5, 18.5, 2.5);  // square (4, 0) takes its corner (16, 4), which the start then replaces
  const Graph& graph = graph_of(map, {4.0, 0.4}, agents_at({{15.5, 3.6}}));
  EXPECT_EQ(graph.nodes(), 20);
  EXPECT_EQ(node_at(graph, {16.0, 4.0}), -1);
  EXPECT_GE(graph.find(0, node_at(graph, {2.0, 6.0})), 0);   // column 0, three from its own
  EXPECT_GE(graph.find(0, node_at(graph, {30.0, 6.0})), 0);  // column 7, three from the other
  EXPECT_EQ(graph.find(0, node_at(graph, {34.0, 6.0})), -1);
  EXPECT_GE(graph.find(node_at(graph, {30.0, 6.0}), 0), 0);
}

TEST(Graph, KeepsTwoStartsOnOnePlaceApart) {
  const Graph& graph = graph_of(DrawnMap(40.0, 40.0, 0.25), {}, agents_at({{1.75, 1.75}, {1.75, 1.75}}));
  EXPECT_EQ(graph.nodes(), 145);
  EXPECT_EQ(graph.position(0), graph.position(1));
  const Edge between = graph.find(0, 1);
  ASSERT_GE(between, 0);
  EXPECT_EQ(graph.length_m(between), 0.0);
  EXPECT_EQ(degree(graph, 0), 16);
  EXPECT_EQ(degree(graph, 1), 16);
}

TEST(Graph, MayHaveOneNode) {
  const Graph& graph = graph_of(DrawnMap(3.0, 3.0, 0.25), {}, agents_at({{1.5, 1.5}}));
  EXPECT_EQ(graph.nodes(), 1);
  EXPECT_EQ(graph.edges(), 0);
  EXPECT_EQ(graph.nodes_reached_by(0), 1);
  EXPECT_EQ(graph.edges_open_to(0), 0);
  EXPECT_EQ(graph.reached_by(0), agent_bit(0));
}

TEST(Graph, EndsForAnAgentWhereAWallShutsItIn) {
  DrawnMap map(20.0, 10.0, 0.25);
  map.put(kWall, 9.75, 0.0, 10.25, 10.0);
  const Graph& graph = graph_of(map, {2.5, 0.4}, agents_at({{1.25, 1.25}, {18.75, 1.25}}));
  ASSERT_EQ(graph.nodes(), 32);
  for (Node n = 0; n < graph.nodes(); ++n) {
    EXPECT_EQ(graph.reached_by(n), agent_bit(graph.position(n).x_m < 10.0 ? 0 : 1));
    for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
      EXPECT_EQ(graph.open_to(e), graph.reached_by(n));
    }
  }
  EXPECT_EQ(graph.nodes_reached_by(0), 16);
  EXPECT_EQ(graph.nodes_reached_by(1), 16);
  EXPECT_EQ(graph.edges_open_to(0) + graph.edges_open_to(1), graph.edges());
}

TEST(Graph, LetsAPersonUseStairsThatARobotMayNot) {
  DrawnMap map(20.0, 10.0, 0.25);
  map.put(kStairs, 9.0, 0.0, 11.0, 10.0);
  GraphAgents agents = agents_at({{1.25, 1.25}, {3.75, 1.25}});
  agents[1].kind = AgentKind::kPerson;
  const Graph& graph = graph_of(map, {2.5, 0.4}, agents);
  EXPECT_EQ(graph.nodes_reached_by(0),
            12);  // three columns end at 7.5; the fourth has its nodes on 8.75, a foot in the stairs
  EXPECT_EQ(graph.nodes_reached_by(1), 32);
  for (Node n = 0; n < graph.nodes(); ++n) {
    EXPECT_EQ(in(graph.reached_by(n), 0), graph.position(n).x_m < 8.0);
  }
}

TEST(Graph, KeepsAnAgentOutOfItsOwnRestrictedAreasOnly) {
  GraphAgents agents = agents_at({{1.25, 1.25}, {3.75, 1.25}});
  ASSERT_TRUE(
      agents[0].restricted.push_back(test::rectangle(9.5, -1.0, 9.8, 11.0)));  // no node inside, but every path crosses
  const Graph& graph = graph_of(DrawnMap(20.0, 10.0, 0.25), {2.5, 0.4}, agents);
  EXPECT_EQ(graph.nodes_reached_by(0), 16);
  EXPECT_EQ(graph.nodes_reached_by(1), 32);
}

TEST(Graph, ToldOfAWiderFootprintLosesTheNarrowGap) {
  DrawnMap map(20.0, 10.0, 0.25);
  map.put(kWall, 9.75, 0.0, 10.25, 5.75).put(kWall, 9.75, 6.75, 10.25, 10.0);  // a gap of 1 m around the row at 6.25
  GraphAgents agents = agents_at({{1.25, 1.25}, {3.75, 1.25}});
  agents[0].footprint_radius_m = 0.49;
  agents[1].footprint_radius_m = 0.51;
  const Graph& graph = graph_of(map, {2.5, 0.4}, agents);
  EXPECT_EQ(graph.nodes_reached_by(0), 32);
  EXPECT_EQ(graph.nodes_reached_by(1), 16);
}

TEST(Graph, LetsAnAgentLeaveAStartThatTouchesAnObstacleOrTheBorder) {
  DrawnMap map(40.0, 40.0, 0.25);
  map.put(kWall, 10.0, 10.0, 20.0, 11.0);
  for (const Point start : {Point{39.7, 5.0}, Point{0.3, 0.3}, Point{15.0, 9.7}, Point{15.0, 11.3}, Point{9.7, 10.5}}) {
    EXPECT_GT(graph_of(map, {}, agents_at({start})).nodes_reached_by(0), 100) << start.x_m << ", " << start.y_m;
  }
}

}  // namespace
}  // namespace ivo::planner
