#include <algorithm>
#include <cmath>

#include "planner/world/collision.hpp"
#include "planner/world/distance.hpp"
#include "planner/world/graph.hpp"
#include "planner/world/node_placement.hpp"

namespace ivo::planner {
namespace {

bool may_stand(const SegmentedMap& map, const GraphAgent& agent, Point p) noexcept {
  const int column = static_cast<int>(p.x_m / map.resolution_m);
  const int row = static_cast<int>(p.y_m / map.resolution_m);
  const bool class_ok = !map.properties(map.at(column, row)).restricted[static_cast<std::size_t>(agent.kind)];
  return class_ok && !contains(agent.restricted, p);
}

// Agents that may move straight from a to b: footprint clear of obstacles and restricted classes, path clear of
// restricted areas.
AgentSet agents_on(const SegmentedMap& map, const GraphAgents& agents, Point a, Point b) noexcept {
  AgentSet open = 0;
  double proved_radius_m = -1.0;  // the answer for the last footprint serves the next agent of the same kind and size
  AgentKind proved_kind{};
  bool proved_free = false;
  for (std::size_t m = 0; m < agents.size(); ++m) {
    const GraphAgent& agent = agents[m];
    if (!may_stand(map, agent, a) || !may_stand(map, agent, b) || touches(agent.restricted, a, b)) {
      continue;
    }
    if (agent.footprint_radius_m != proved_radius_m || agent.kind != proved_kind) {
      const auto blocked =
          static_cast<ClassSet>(obstacle_classes(map.classes) | restricted_classes(map.classes, agent.kind));
      proved_free = swept_disc_is_free(map, blocked, a, b, agent.footprint_radius_m);
      proved_radius_m = agent.footprint_radius_m;
      proved_kind = agent.kind;
    }
    if (proved_free) {
      open = static_cast<AgentSet>(open | agent_bit(static_cast<int>(m)));
    }
  }
  return open;
}

}  // namespace

Refusal Graph::build(const SegmentedMap& map, const GraphParameters& parameters, const GraphAgents& agents) noexcept {
  constexpr double kWhole = 1e-9;  // 10 m / 2.5 m is 4 squares, whatever the rounding
  const double columns = std::max(1.0, std::ceil(map.width_m() / parameters.spacing_m - kWhole));
  const double rows = std::max(1.0, std::ceil(map.height_m() / parameters.spacing_m - kWhole));
  if (columns * rows > static_cast<double>(kSquares)) {
    return {.code = RefusalCode::kTooManySquares, .value = columns * rows, .limit = static_cast<double>(kSquares)};
  }
  columns_ = static_cast<int>(columns);
  rows_ = static_cast<int>(rows);
  spacing_m_ = parameters.spacing_m;
  nodes_ = 0;
  agents_ = static_cast<int>(agents.size());
  square_node_.fill(kNone);
  next_square_.fill(kNone);
  first_square_.fill(kNone);

  if (const Refusal refusal = place_starts(map, agents)) {
    return refusal;
  }
  if (const Refusal refusal = place_nodes(map, parameters)) {
    return refusal;
  }
  if (const Refusal refusal = connect(map, agents)) {
    return refusal;
  }
  reach();
  return {};
}

Refusal Graph::place_starts(const SegmentedMap& map, const GraphAgents& agents) noexcept {
  constexpr double kRounding = 1e-9;  // a start exactly one footprint away is free
  const ClassSet obstacles = obstacle_classes(map.classes);
  for (std::size_t m = 0; m < agents.size(); ++m) {
    const GraphAgent& agent = agents[m];
    const int number = static_cast<int>(m);
    if (!map.contains(agent.start)) {
      return {.code = RefusalCode::kStartOutsideMap, .agent = number};
    }
    const double free_m = clearance(map, obstacles, agent.start, agent.footprint_radius_m);
    if (free_m < agent.footprint_radius_m - kRounding) {
      return {.code = RefusalCode::kStartBlocked, .agent = number, .value = free_m, .limit = agent.footprint_radius_m};
    }
    if (!may_stand(map, agent, agent.start)) {
      return {.code = RefusalCode::kStartRestricted, .agent = number};
    }
    positions_[m] = agent.start;
    ++nodes_;
  }
  return {};
}

int Graph::square_of(Point p) const noexcept {
  const int column = std::min(columns_ - 1, static_cast<int>(p.x_m / spacing_m_));
  const int row = std::min(rows_ - 1, static_cast<int>(p.y_m / spacing_m_));
  return row * columns_ + column;
}

// The nearest earlier node closer than h/4: a start, or the node of a square next to this one (ties: the earliest).
Node Graph::merge_target(Point p, int column, int row) const noexcept {
  Node nearest = kNone;
  double nearest_m = spacing_m_ / 4;
  const auto consider = [&](Node n) {
    const double d = distance_m(positions_[index(n)], p);
    if (d < nearest_m || (d == nearest_m && nearest != kNone && n < nearest)) {
      nearest = n;
      nearest_m = d;
    }
  };
  for (Node start = 0; start < agents_; ++start) {
    consider(start);
  }
  for (int y = std::max(0, row - 1); y <= row; ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x) {
      if (const Node n = square_node_[index(y * columns_ + x)]; n != kNone) {
        consider(n);
      }
    }
  }
  return nearest;
}

Refusal Graph::place_nodes(const SegmentedMap& map, const GraphParameters& parameters) noexcept {
  int beyond = 0;  // nodes that there is no room for
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Square square{column * spacing_m_, row * spacing_m_, std::min((column + 1) * spacing_m_, map.width_m()),
                          std::min((row + 1) * spacing_m_, map.height_m())};
      const std::optional<Point> place = place_node(map, square, parameters.clearance_m);
      if (!place) {
        continue;
      }
      Node node = merge_target(*place, column, row);
      if (node == kNone) {
        if (nodes_ == limits::kNodes) {
          ++beyond;
          continue;
        }
        node = nodes_++;
        positions_[index(node)] = *place;
      }
      const int number = row * columns_ + column;
      square_node_[index(number)] = node;
      next_square_[index(number)] = first_square_[index(node)];
      first_square_[index(node)] = number;
    }
  }
  if (beyond > 0) {
    return {.code = RefusalCode::kTooManyNodes, .value = nodes_ + static_cast<double>(beyond), .limit = limits::kNodes};
  }
  return {};
}

void Graph::collect_window(int square, Node n) noexcept {
  const auto collect = [&](Node candidate) {
    if (candidate != n && marked_for_[index(candidate)] != n) {
      marked_for_[index(candidate)] = n;
      scratch_[index(scratch_size_++)] = candidate;
    }
  };
  const auto near = [&](int other) {
    return std::abs(other % columns_ - square % columns_) <= kWindow &&
           std::abs(other / columns_ - square / columns_) <= kWindow;
  };
  for (Node start = 0; start < agents_; ++start) {
    if (near(square_of(positions_[index(start)]))) {
      collect(start);
    }
  }
  const int column = square % columns_;
  const int row = square / columns_;
  for (int y = std::max(0, row - kWindow); y <= std::min(rows_ - 1, row + kWindow); ++y) {
    for (int x = std::max(0, column - kWindow); x <= std::min(columns_ - 1, column + kWindow); ++x) {
      if (const Node node = square_node_[index(y * columns_ + x)]; node != kNone) {
        collect(node);
      }
    }
  }
}

// A node's neighbourhood is that of all its squares; a start's own square counts too, though another node may stand in
// it.
int Graph::collect_neighbours(Node n) noexcept {
  // Squares that merge into one node are within two by two: together their windows are a square wider each way.
  static_assert((2 * kWindow + 2) * (2 * kWindow + 2) + limits::kAgents <= limits::kNeighbours);
  scratch_size_ = 0;
  if (n < agents_) {
    collect_window(square_of(positions_[index(n)]), n);
  }
  for (int square = first_square_[index(n)]; square != kNone; square = next_square_[index(square)]) {
    collect_window(square, n);
  }
  std::sort(scratch_.begin(), scratch_.begin() + scratch_size_);
  return scratch_size_;
}

Refusal Graph::connect(const SegmentedMap& map, const GraphAgents& agents) noexcept {
  marked_for_.fill(kNone);
  Edge edge = 0;
  for (Node n = 0; n < nodes_; ++n) {
    first_edge_[index(n)] = edge;
    const int neighbours = collect_neighbours(n);
    for (int i = 0; i < neighbours; ++i) {
      const Node other = scratch_[index(i)];
      AgentSet open = 0;
      if (other < n) {
        const Edge back = find(other, n);  // proved when `other` had its turn
        open = back == kNone ? AgentSet{0} : open_to_[index(back)];
      } else {
        open = agents_on(map, agents, positions_[index(n)], positions_[index(other)]);
      }
      if (open == 0) {
        continue;
      }
      if (edge == limits::kEdges) {
        return {.code = RefusalCode::kTooManyEdges, .value = edge + 1.0, .limit = limits::kEdges};
      }
      heads_[index(edge)] = other;
      lengths_m_[index(edge)] = distance_m(positions_[index(n)], positions_[index(other)]);
      open_to_[index(edge)] = open;
      ++edge;
    }
    first_edge_[index(n) + 1] = edge;
  }
  return {};
}

}  // namespace ivo::planner
