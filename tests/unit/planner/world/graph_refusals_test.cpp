#include <gtest/gtest.h>

#include "planner/world/graph.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

Refusal build(const DrawnMap& map, const GraphParameters& parameters, const GraphAgents& agents) {
  static Graph graph;
  return graph.build(map.view(), parameters, agents);
}

// The second of two agents is the one in trouble.
GraphAgents second_at(Point start) {
  GraphAgents agents;
  agents.resize(2);
  agents[0].start = {10.0, 10.0};
  agents[1].start = start;
  return agents;
}

TEST(GraphRefusal, NamesTheAgentThatStartsOutsideTheMap) {
  for (const Point outside : {Point{-0.1, 5.0}, Point{5.0, 20.0}, Point{20.0, 5.0}, Point{5.0, -3.0}}) {
    const Refusal refusal = build(DrawnMap(20.0, 20.0, 0.25), {}, second_at(outside));
    EXPECT_EQ(refusal.code, RefusalCode::kStartOutsideMap);
    EXPECT_EQ(refusal.agent, 1);
  }
}

TEST(GraphRefusal, GivesTheClearanceOfABlockedStartAndTheFootprint) {
  DrawnMap map(20.0, 20.0, 0.25);
  map.put(kShrub, 4.0, 4.0, 6.0, 6.0);
  const Refusal inside = build(map, {}, second_at({5.0, 5.0}));
  EXPECT_EQ(inside.code, RefusalCode::kStartBlocked);
  EXPECT_EQ(inside.agent, 1);
  EXPECT_EQ(inside.value, 0.0);
  EXPECT_EQ(inside.limit, 0.30);
  const Refusal near = build(map, {}, second_at({3.8, 5.0}));
  EXPECT_EQ(near.code, RefusalCode::kStartBlocked);
  EXPECT_NEAR(near.value, 0.2, 1e-9);
  const Refusal border = build(map, {}, second_at({19.9, 5.0}));
  EXPECT_EQ(border.code, RefusalCode::kStartBlocked);
  EXPECT_NEAR(border.value, 0.1, 1e-9);
}

TEST(GraphRefusal, NamesTheAgentThatStartsWhereItMayNotBe) {
  DrawnMap map(20.0, 20.0, 0.25);
  map.put(kStairs, 4.0, 4.0, 6.0, 6.0);
  GraphAgents agents = second_at({5.0, 5.0});
  const Refusal robot = build(map, {}, agents);
  EXPECT_EQ(robot.code, RefusalCode::kStartRestricted);
  EXPECT_EQ(robot.agent, 1);
  agents[1].kind = AgentKind::kPerson;
  EXPECT_FALSE(build(map, {}, agents));
  Area area;
  for (const Point p : {Point{4, 4}, Point{6, 4}, Point{6, 6}, Point{4, 6}}) {
    ASSERT_TRUE(area.push_back(p));
  }
  ASSERT_TRUE(agents[1].restricted.push_back(area));
  const Refusal person = build(map, {}, agents);
  EXPECT_EQ(person.code, RefusalCode::kStartRestricted);
  EXPECT_EQ(person.agent, 1);
}

TEST(GraphRefusal, CountsSquaresAndNodesOverTheCapacity) {
  const DrawnMap map(40.0, 40.0, 0.5);
  const int squares = 2 * limits::kNodes;
  const double too_fine = 40.0 / (std::ceil(std::sqrt(squares)) + 1.0);
  const Refusal many_squares = build(map, {too_fine, 0.1}, second_at({5.0, 5.0}));
  EXPECT_EQ(many_squares.code, RefusalCode::kTooManySquares);
  EXPECT_GT(many_squares.value, squares);
  EXPECT_EQ(many_squares.limit, squares);
  const double fine = 40.0 / (std::ceil(std::sqrt(limits::kNodes)) + 1.0);
  const Refusal many_nodes = build(map, {fine, 0.1}, second_at({5.0, 5.0}));
  EXPECT_EQ(many_nodes.code, RefusalCode::kTooManyNodes);
  const double side = std::ceil(40.0 / fine - 1e-9);
  EXPECT_GT(many_nodes.value, limits::kNodes);
  EXPECT_LE(many_nodes.value, side * side + 2);
  EXPECT_EQ(many_nodes.limit, limits::kNodes);
}

}  // namespace
}  // namespace ivo::planner
