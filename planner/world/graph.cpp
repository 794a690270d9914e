#include "planner/world/graph.hpp"

#include <algorithm>

#include "planner/world/distance.hpp"
#include "planner/world/graph_table.hpp"

namespace ivo::planner {

Refusal Graph::load(const GraphTable& table, const GraphAgents& agents) noexcept {
  constexpr Refusal kUnfit{.code = RefusalCode::kGraphTableUnfit};
  const std::size_t nodes = table.positions.size();
  const std::size_t edges = table.heads.size();
  if (nodes > positions_.size()) {
    return {.code = RefusalCode::kTooManyNodes, .value = static_cast<double>(nodes), .limit = limits::kNodes};
  }
  if (edges > heads_.size()) {
    return {.code = RefusalCode::kTooManyEdges, .value = static_cast<double>(edges), .limit = limits::kEdges};
  }
  if (table.first_edge.size() != nodes + 1 || table.open_to.size() != edges || !(table.spacing_m > 0.0) ||
      table.agents != static_cast<int>(agents.size()) || agents.size() > nodes) {
    return kUnfit;
  }
  for (std::size_t m = 0; m < agents.size(); ++m) {
    if (table.positions[m] != agents[m].start) {
      return kUnfit;
    }
  }
  spacing_m_ = table.spacing_m;
  agents_ = table.agents;
  nodes_ = static_cast<int>(nodes);
  std::copy(table.positions.begin(), table.positions.end(), positions_.begin());
  std::copy(table.first_edge.begin(), table.first_edge.end(), first_edge_.begin());
  std::copy(table.heads.begin(), table.heads.end(), heads_.begin());
  std::copy(table.open_to.begin(), table.open_to.end(), open_to_.begin());
  if (this->edges() != static_cast<int>(edges) || !is_whole()) {
    forget();
    return kUnfit;
  }
  for (Node n = 0; n < nodes_; ++n) {
    if (end_edge(n) - first_edge(n) > limits::kNeighbours) {
      const auto neighbours = static_cast<double>(end_edge(n) - first_edge(n));
      forget();
      return {.code = RefusalCode::kTooManyNeighbours, .value = neighbours, .limit = limits::kNeighbours};
    }
    for (Edge e = first_edge(n); e < end_edge(n); ++e) {
      lengths_m_[index(e)] = distance_m(position(n), position(head(e)));
    }
  }
  reach();
  return {};
}

void Graph::forget() noexcept {
  nodes_ = 0;
  agents_ = 0;
  first_edge_[0] = 0;
}

// Rows in order from 0 on; in a row, heads that ascend, none its own node, each with its way back for the same agents.
bool Graph::is_whole() const noexcept {
  if (first_edge_[0] != 0) {
    return false;
  }
  for (Node n = 0; n < nodes_; ++n) {
    if (end_edge(n) < first_edge(n) || end_edge(n) > edges()) {
      return false;
    }
  }
  for (Node n = 0; n < nodes_; ++n) {
    for (Edge e = first_edge(n); e < end_edge(n); ++e) {
      const Node to = head(e);
      const bool ascends = e == first_edge(n) || head(e - 1) < to;
      if (to < 0 || to >= nodes_ || to == n || !ascends || (open_to(e) >> static_cast<unsigned>(agents_)) != 0) {
        return false;
      }
    }
  }
  for (Node n = 0; n < nodes_; ++n) {
    for (Edge e = first_edge(n); e < end_edge(n); ++e) {
      const Edge back = find(head(e), n);
      if (back == kNone || open_to(back) != open_to(e)) {
        return false;
      }
    }
  }
  return true;
}

GraphTable Graph::table() const noexcept {
  const std::size_t nodes = index(nodes_);
  const std::size_t edges = index(this->edges());
  return {.spacing_m = spacing_m_,
          .agents = agents_,
          .positions = {positions_.data(), nodes},
          .first_edge = {first_edge_.data(), nodes + 1},
          .heads = {heads_.data(), edges},
          .open_to = {open_to_.data(), edges}};
}

Edge Graph::find(Node a, Node b) const noexcept {
  const Node* const first = heads_.data() + first_edge(a);
  const Node* const last = heads_.data() + end_edge(a);
  const Node* const found = std::lower_bound(first, last, b);
  return found != last && *found == b ? static_cast<Edge>(found - heads_.data()) : kNone;
}

// Breadth first from each start; then edges keep only the agents that can get to them.
void Graph::reach() noexcept {
  std::fill_n(reached_by_.begin(), nodes_, AgentSet{0});
  reached_count_.fill(0);
  open_count_.fill(0);
  for (int agent = 0; agent < agents_; ++agent) {
    int head_of_queue = 0;
    int queued = 0;
    const auto visit = [&](Node n) {
      if (!in(reached_by_[index(n)], agent)) {
        reached_by_[index(n)] = static_cast<AgentSet>(reached_by_[index(n)] | agent_bit(agent));
        scratch_[index(queued++)] = n;
      }
    };
    visit(agent);
    while (head_of_queue < queued) {
      const Node n = scratch_[index(head_of_queue++)];
      for (Edge e = first_edge(n); e < end_edge(n); ++e) {
        if (in(open_to(e), agent)) {
          visit(head(e));
        }
      }
    }
    reached_count_[index(agent)] = queued;
  }
  for (Node n = 0; n < nodes_; ++n) {
    for (Edge e = first_edge(n); e < end_edge(n); ++e) {
      open_to_[index(e)] = static_cast<AgentSet>(open_to_[index(e)] & reached_by_[index(n)]);
      for (int agent = 0; agent < agents_; ++agent) {
        open_count_[index(agent)] += in(open_to_[index(e)], agent) ? 1 : 0;
      }
    }
  }
}

}  // namespace ivo::planner
