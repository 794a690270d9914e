#include "planner/search/jump_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Relaxes every edge until nothing changes.
std::vector<double> slow_distances_m(const Graph& graph, int agent, Node from) {
  std::vector<double> distance_m(static_cast<std::size_t>(graph.nodes()), kFar);
  distance_m[static_cast<std::size_t>(from)] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (Node n = 0; n < graph.nodes(); ++n) {
      for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
        double& known = distance_m[static_cast<std::size_t>(graph.head(e))];
        const double d = distance_m[static_cast<std::size_t>(n)] + graph.length_m(e);
        if (in(graph.open_to(e), agent) && d < known) {
          known = d;
          changed = true;
        }
      }
    }
  }
  return distance_m;
}

Graph& walled_graph() {
  static Graph graph;
  test::DrawnMap map(28.0, 21.0, 0.25);
  map.put(SemanticClass::kWall, 9.0, 4.0, 9.5, 21.0).put(SemanticClass::kWall, 18.0, 0.0, 18.5, 17.0);
  map.put(SemanticClass::kStairs, 18.0, 17.0, 18.5, 21.0);
  GraphAgents agents;
  agents.resize(2);
  agents[0].start = {1.75, 1.75};
  agents[1].start = {5.25, 1.75};
  agents[1].kind = AgentKind::kPerson;
  EXPECT_FALSE(graph.build(map.view(), {}, agents));
  return graph;
}

Node next_of(JumpSearch& jump) {
  Node n = jump.settle_next();
  while (n == JumpSearch::kCatchingUp) {
    n = jump.settle_next();
  }
  return n;
}

TEST(JumpSearch, SettlesEveryNodeThatTheAgentCanReachInOrderOfItsDistance) {
  const Graph& graph = walled_graph();
  static JumpSearch jump;
  jump.open(graph);
  std::mt19937 random(2);
  for (int i = 0; i < 40; ++i) {
    const int agent = i % 2;
    Node from = static_cast<Node>(random() % static_cast<unsigned>(graph.nodes()));
    while (!in(graph.reached_by(from), agent)) {
      from = static_cast<Node>(random() % static_cast<unsigned>(graph.nodes()));
    }
    const std::vector<double> distances_m = slow_distances_m(graph, agent, from);
    jump.start(agent, from);
    int settled = 0;
    double before_m = 0.0;
    for (Node n = next_of(jump); n >= 0; n = next_of(jump)) {
      ++settled;
      double length_m = 0.0;
      for (Node step = n; jump.edge_to(step) >= 0; step = jump.before(step)) {
        ASSERT_EQ(graph.head(jump.edge_to(step)), step);
        ASSERT_EQ(graph.find(jump.before(step), step), jump.edge_to(step));
        ASSERT_TRUE(in(graph.open_to(jump.edge_to(step)), agent));
        length_m += graph.length_m(jump.edge_to(step));
      }
      ASSERT_NEAR(length_m, distances_m[static_cast<std::size_t>(n)], 1e-9);
      ASSERT_GE(length_m, before_m - 1e-9);
      before_m = length_m;
    }
    ASSERT_EQ(settled, graph.nodes_reached_by(agent));
    ASSERT_EQ(jump.settle_next(), -1);
  }
  EXPECT_LT(graph.nodes_reached_by(0), graph.nodes_reached_by(1));
}

TEST(JumpSearch, TellsOfNodesItRemembersAsIfItSearchedForThem) {
  static Graph graph;
  GraphAgents agents;
  agents.resize(2);
  agents[0].start = {1.75, 1.75};
  agents[1].start = {26.25, 1.75};
  ASSERT_FALSE(graph.build(test::DrawnMap(28.0, 28.0, 0.25).view(), {2.0, 0.4}, agents));  // more nodes than remembered
  static JumpSearch remembering;
  static JumpSearch anew;
  remembering.open(graph);
  std::mt19937 random(3);
  int caught_up = 0;
  for (int i = 0; i < 400; ++i) {
    const int agent = i % 2;
    const Node from = static_cast<Node>(random() % 12);
    const int wanted = static_cast<int>(random() % (i % 7 == 0 ? 220 : 60));
    remembering.start(agent, from);
    anew.open(graph);
    anew.start(agent, from);
    for (int k = 0; k < wanted; ++k) {
      Node n = remembering.settle_next();
      for (; n == JumpSearch::kCatchingUp; n = remembering.settle_next()) {
        ++caught_up;
      }
      ASSERT_EQ(n, anew.settle_next()) << "start " << i << ", node " << k;
      if (n < 0) {
        break;
      }
      ASSERT_EQ(remembering.edge_to(n), anew.edge_to(n));
      ASSERT_EQ(remembering.before(n), anew.before(n));
    }
  }
  EXPECT_GT(caught_up, 100);
  EXPECT_GT(graph.nodes(), 150);
}

TEST(JumpSearch, SettlesTheLowestNodeFirstOnATie) {
  static Graph graph;
  GraphAgents agents;
  agents.resize(1);
  agents[0].start = {9.0, 9.0};
  ASSERT_FALSE(graph.build(test::DrawnMap(18.0, 18.0, 0.5).view(), {2.0, 0.4}, agents));
  static JumpSearch jump;
  jump.open(graph);
  jump.start(0, 0);
  EXPECT_EQ(jump.settle_next(), 0);
  Node before = -1;
  for (int i = 0; i < 4; ++i) {  // the four nodes two metres away
    const Node n = jump.settle_next();
    EXPECT_EQ(graph.length_m(jump.edge_to(n)), 2.0);
    EXPECT_GT(n, before);
    before = n;
  }
}

}  // namespace
}  // namespace ivo::planner
