#include "planner/world/sight_table.hpp"

#include <algorithm>

#include "planner/numeric/index.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::planner {
namespace {

constexpr std::int16_t kUnseen = -1;

Refusal full(int events) noexcept {
  return {.code = RefusalCode::kSightTableFull, .value = static_cast<double>(events), .limit = limits::kSightEvents};
}

}  // namespace

Refusal SightTable::build(const Cells& cells, const Graph& graph, const SightRadii& radii_m,
                          std::span<const double> mass) noexcept {
  events_ = 0;
  layers_ = 0;
  mass_ = mass;
  observable_by_.fill(0);
  first_point_.fill(kUnseen);
  for (int agent = 0; agent < graph.agents(); ++agent) {
    const double radius_m = radii_m[index(agent)];
    int layer = 0;
    while (layer < layers_ && layer_radius_m_[index(layer)] != radius_m) {
      ++layer;
    }
    if (layer == layers_) {
      layer_radius_m_[index(layer)] = radius_m;
      layer_agents_[index(layer)] = 0;
      ++layers_;
    }
    layer_of_agent_[index(agent)] = layer;
    layer_agents_[index(layer)] = static_cast<AgentSet>(layer_agents_[index(layer)] | agent_bit(agent));
  }
  for (int layer = 0; layer < layers_; ++layer) {
    if (const Refusal refusal = add_nodes(cells, graph, layer)) {
      return refusal;
    }
    if (const Refusal refusal = add_edges(cells, graph, layer)) {
      return refusal;
    }
  }
  return {};
}

bool SightTable::keep(Cell cell, int point) noexcept {
  if (events_ == limits::kSightEvents) {
    return false;
  }
  pool_[index(events_++)] = SightEvent(cell, point);
  return true;
}

Refusal SightTable::add_nodes(const Cells& cells, const Graph& graph, int layer) noexcept {
  for (Node n = 0; n < graph.nodes(); ++n) {
    const auto agents = static_cast<AgentSet>(graph.reached_by(n) & layer_agents_[index(layer)]);
    Rows& rows = node_rows_[index(layer)][index(n)];
    rows = {events_, 0};
    if (agents == 0) {
      continue;
    }
    bool kept = true;
    for_each_seen(cells, graph.position(n), layer_radius_m_[index(layer)], [&](Cell c) {
      if (mass_[index(c)] > 0.0) {
        kept = kept && keep(c, 0);
        observable_by_[index(c)] = static_cast<AgentSet>(observable_by_[index(c)] | agents);
      }
    });
    if (!kept) {
      return full(events_);
    }
    rows.count = events_ - rows.first;
  }
  return {};
}

// Both directions of an edge have the same sight points, so one look serves both: a cell's first point from one end is
// its last from the other.
Refusal SightTable::add_edges(const Cells& cells, const Graph& graph, int layer) noexcept {
  EdgeRows& rows = edge_rows_[index(layer)];
  for (Node n = 0; n < graph.nodes(); ++n) {
    for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
      const Node head = graph.head(e);
      if (head < n) {
        continue;
      }
      const Edge back = graph.find(head, n);
      const int points = sight_points(graph.length_m(e), cells.cell_m());
      if (points > SightEvent::kMaxPoint) {
        return {
            .code = RefusalCode::kEdgeTooLong, .value = static_cast<double>(points), .limit = SightEvent::kMaxPoint};
      }
      points_[index(e)] = points_[index(back)] = static_cast<std::int16_t>(points);
      rows[index(e)] = rows[index(back)] = {events_, 0};
      const auto agents = static_cast<AgentSet>(graph.open_to(e) & layer_agents_[index(layer)]);
      if (agents == 0) {
        continue;
      }
      look_along(cells, graph.position(n), graph.position(head), points, layer_radius_m_[index(layer)]);
      bool kept = true;
      for (int i = 0; i < seen_count_; ++i) {
        const Cell c = seen_[index(i)];
        observable_by_[index(c)] = static_cast<AgentSet>(observable_by_[index(c)] | agents);
        kept = kept && (first_point_[index(c)] == 0 || keep(c, first_point_[index(c)]));
      }
      rows[index(e)].count = events_ - rows[index(e)].first;
      rows[index(back)].first = events_;
      for (int i = 0; i < seen_count_; ++i) {
        const Cell c = seen_[index(i)];
        kept = kept && (last_point_[index(c)] == points || keep(c, points - last_point_[index(c)]));
        first_point_[index(c)] = kUnseen;
      }
      rows[index(back)].count = events_ - rows[index(back)].first;
      if (!kept) {
        return full(events_);
      }
    }
  }
  return {};
}

void SightTable::look_along(const Cells& cells, Point a, Point b, int points, double radius_m) noexcept {
  seen_count_ = 0;
  for (int k = 0; k <= points; ++k) {
    for_each_seen(cells, sight_point(a, b, k, points), radius_m, [&](Cell c) {
      if (mass_[index(c)] <= 0.0) {
        return;
      }
      if (first_point_[index(c)] == kUnseen) {
        first_point_[index(c)] = static_cast<std::int16_t>(k);
        seen_[index(seen_count_++)] = c;
      }
      last_point_[index(c)] = static_cast<std::int16_t>(k);
    });
  }
}

std::span<const SightEvent> SightTable::from_node(int agent, Node n) const noexcept {
  const Rows rows = node_rows_[index(layer_of_agent_[index(agent)])][index(n)];
  return {pool_.data() + rows.first, static_cast<std::size_t>(rows.count)};
}

std::span<const SightEvent> SightTable::along_edge(int agent, Edge e) const noexcept {
  const Rows rows = edge_rows_[index(layer_of_agent_[index(agent)])][index(e)];
  return {pool_.data() + rows.first, static_cast<std::size_t>(rows.count)};
}

}  // namespace ivo::planner
