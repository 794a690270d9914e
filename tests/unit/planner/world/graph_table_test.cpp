#include "planner/world/graph_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "tests/support/drawn_map.hpp"
#include "tests/support/star.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

// A graph with stairs for one agent, a wall, and a node that nobody reaches.
class GraphTableTest : public testing::Test {
 protected:
  GraphTableTest() {
    DrawnMap map(20.0, 10.0, 0.25);
    map.put(kWall, 14.75, 0.0, 15.25, 10.0).put(kStairs, 9.0, 0.0, 11.0, 10.0);
    agents_.resize(2);
    agents_[0].start = {1.3, 1.25};
    agents_[1].start = {3.75, 1.1};
    agents_[1].kind = AgentKind::kPerson;
    EXPECT_FALSE(built_->build(map.view(), {2.5, 0.4}, agents_));
    const GraphTable table = built_->table();
    positions_.assign(table.positions.begin(), table.positions.end());
    first_edge_.assign(table.first_edge.begin(), table.first_edge.end());
    heads_.assign(table.heads.begin(), table.heads.end());
    open_to_.assign(table.open_to.begin(), table.open_to.end());
  }

  [[nodiscard]] GraphTable table() const {
    return {.spacing_m = spacing_m_,
            .agents = table_agents_,
            .positions = positions_,
            .first_edge = first_edge_,
            .heads = heads_,
            .open_to = open_to_};
  }
  RefusalCode load() { return loaded_->load(table(), agents_).code; }

  std::unique_ptr<Graph> built_ = std::make_unique<Graph>();
  std::unique_ptr<Graph> loaded_ = std::make_unique<Graph>();
  GraphAgents agents_;
  double spacing_m_ = 2.5;
  int table_agents_ = 2;
  std::vector<Point> positions_;
  std::vector<Edge> first_edge_;
  std::vector<Node> heads_;
  std::vector<AgentSet> open_to_;
};

TEST_F(GraphTableTest, MakesTheGraphThatItWasTakenFrom) {
  ASSERT_EQ(load(), RefusalCode::kNone);
  ASSERT_EQ(loaded_->nodes(), built_->nodes());
  ASSERT_EQ(loaded_->edges(), built_->edges());
  EXPECT_EQ(loaded_->agents(), built_->agents());
  EXPECT_EQ(loaded_->spacing_m(), built_->spacing_m());
  for (Node n = 0; n < built_->nodes(); ++n) {
    EXPECT_EQ(loaded_->position(n), built_->position(n));
    EXPECT_EQ(loaded_->reached_by(n), built_->reached_by(n));
    EXPECT_EQ(loaded_->first_edge(n), built_->first_edge(n));
  }
  for (Edge e = 0; e < built_->edges(); ++e) {
    EXPECT_EQ(loaded_->head(e), built_->head(e));
    EXPECT_EQ(loaded_->length_m(e), built_->length_m(e));
    EXPECT_EQ(loaded_->open_to(e), built_->open_to(e));
  }
  for (int agent = 0; agent < 2; ++agent) {
    EXPECT_EQ(loaded_->nodes_reached_by(agent), built_->nodes_reached_by(agent));
    EXPECT_EQ(loaded_->edges_open_to(agent), built_->edges_open_to(agent));
  }
  EXPECT_LT(built_->nodes_reached_by(0), built_->nodes_reached_by(1));
  EXPECT_LT(built_->nodes_reached_by(1), built_->nodes());
}

TEST_F(GraphTableTest, IsRefusedForOtherAgents) {
  agents_[1].start.x_m += 0.01;
  EXPECT_EQ(load(), RefusalCode::kGraphTableUnfit);
  agents_[1].start = positions_[1];
  EXPECT_EQ(load(), RefusalCode::kNone);
  agents_.pop_back();
  EXPECT_EQ(load(), RefusalCode::kGraphTableUnfit);
}

TEST_F(GraphTableTest, IsRefusedWhenItsArraysDoNotFitTogether) {
  first_edge_.pop_back();
  EXPECT_EQ(load(), RefusalCode::kGraphTableUnfit);
  first_edge_ = {built_->table().first_edge.begin(), built_->table().first_edge.end()};
  open_to_.pop_back();
  EXPECT_EQ(load(), RefusalCode::kGraphTableUnfit);
}

TEST_F(GraphTableTest, IsRefusedWithAnyWordThatMakesItNoGraph) {
  const auto refused_with = [this](auto& word, auto wrong) {
    const auto right = word;
    word = static_cast<std::remove_reference_t<decltype(word)>>(wrong);
    const RefusalCode code = load();
    word = right;
    return code == RefusalCode::kGraphTableUnfit;
  };
  EXPECT_TRUE(refused_with(spacing_m_, 0.0));
  EXPECT_TRUE(refused_with(spacing_m_, std::nan("")));
  EXPECT_TRUE(refused_with(table_agents_, 3));
  EXPECT_TRUE(refused_with(first_edge_.front(), 1));
  EXPECT_TRUE(refused_with(first_edge_.back(), 1'000'000));
  EXPECT_TRUE(refused_with(first_edge_[3], -1));
  EXPECT_TRUE(refused_with(first_edge_[3], 1'000'000));
  for (std::size_t e = 0; e < heads_.size(); ++e) {
    ASSERT_TRUE(refused_with(heads_[e], -1)) << e;
    ASSERT_TRUE(refused_with(heads_[e], built_->nodes())) << e;
    ASSERT_TRUE(refused_with(open_to_[e], open_to_[e] ^ 1)) << e;
    ASSERT_TRUE(refused_with(open_to_[e], open_to_[e] | 4)) << e;
    if (e > 0) {
      ASSERT_TRUE(refused_with(heads_[e], heads_[e - 1])) << e;
    }
  }
  EXPECT_EQ(load(), RefusalCode::kNone);
}

TEST_F(GraphTableTest, OverACapacityIsRefusedByName) {
  positions_.resize(limits::kNodes + 1);
  first_edge_.resize(positions_.size() + 1, first_edge_.back());
  const Refusal nodes = loaded_->load(table(), agents_);
  EXPECT_EQ(nodes.code, RefusalCode::kTooManyNodes);
  EXPECT_EQ(nodes.value, limits::kNodes + 1);
  EXPECT_EQ(nodes.limit, limits::kNodes);
  positions_.resize(2);
  heads_.resize(limits::kEdges + 1);
  const Refusal edges = loaded_->load(table(), agents_);
  EXPECT_EQ(edges.code, RefusalCode::kTooManyEdges);
  EXPECT_EQ(edges.value, limits::kEdges + 1);
}

// What weighs a node's neighbours has room for so many.
TEST(GraphTable, WithANodeOfTooManyNeighboursIsRefusedByName) {
  const auto loaded = std::make_unique<Graph>();
  GraphAgents agents;
  agents.resize(1);
  agents[0].start = {100.0, 100.0};
  for (const int neighbours : {limits::kNeighbours, limits::kNeighbours + 1}) {
    const test::Star star(agents[0].start, neighbours, 50.0);
    const Refusal refusal = loaded->load(star.table(), agents);
    if (neighbours == limits::kNeighbours) {
      EXPECT_FALSE(refusal);
      EXPECT_EQ(loaded->edges(), 2 * neighbours);
      continue;
    }
    EXPECT_EQ(refusal.code, RefusalCode::kTooManyNeighbours);
    EXPECT_EQ(refusal.value, neighbours);
    EXPECT_EQ(refusal.limit, limits::kNeighbours);
    EXPECT_EQ(loaded->nodes(), 0);
  }
}

}  // namespace
}  // namespace ivo::planner
