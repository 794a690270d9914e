#include "firmware/tools/bench/rivals/free_ways.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace ivo::firmware::rivals {
namespace {

using planner::Edge;
using planner::index;
using planner::Node;

}  // namespace

FreeWays::FreeWays(const RivalProblem& problem, int agent)
    : problem_(problem),
      agent_(agent),
      body_(problem.search.agents[static_cast<std::size_t>(agent)].body),
      blocked_(static_cast<planner::ClassSet>(planner::obstacle_classes(problem.search.map.classes) |
                                              planner::restricted_classes(problem.search.map.classes, body_.kind))) {}

bool FreeWays::straight(Point a, Point b) const {
  return planner::swept_disc_is_free(problem_.search.map, blocked_, a, b, body_.footprint_radius_m) &&
         !planner::touches(body_.restricted, a, b);
}

std::optional<Node> FreeWays::node_near(Point p) const {
  constexpr std::size_t kTried = 12;
  const planner::Graph& graph = problem_.prepared.graph();
  std::vector<std::pair<double, Node>> nodes;
  for (Node n = 0; n < graph.nodes(); ++n) {
    if (planner::in(graph.reached_by(n), agent_)) {
      nodes.emplace_back(distance_m(p, graph.position(n)), n);
    }
  }
  const std::size_t tried = std::min(kTried, nodes.size());
  std::partial_sort(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(tried), nodes.end());
  for (std::size_t i = 0; i < tried; ++i) {
    if (straight(p, graph.position(nodes[i].second))) {
      return nodes[i].second;
    }
  }
  return std::nullopt;
}

std::optional<std::vector<Point>> FreeWays::way(Point a, Point b) const {
  if (straight(a, b)) {
    return std::vector<Point>{b};
  }
  const std::optional<Node> from = node_near(a);
  const std::optional<Node> to = node_near(b);
  if (!from || !to) {
    return std::nullopt;
  }
  std::vector<Point> corners = over_the_graph(*from, *to);
  corners.insert(corners.begin(), a);
  corners.push_back(b);
  std::vector<Point> kept;
  for (std::size_t i = 0; i + 1 < corners.size();) {
    std::size_t next = i + 1;
    while (next + 1 < corners.size() && straight(corners[i], corners[next + 1])) {
      ++next;
    }
    kept.push_back(corners[next]);
    i = next;
  }
  return kept;
}

std::vector<Point> FreeWays::over_the_graph(Node from, Node to) const {
  const planner::Graph& graph = problem_.prepared.graph();
  std::vector<double> far_m(index(graph.nodes()), std::numeric_limits<double>::infinity());
  std::vector<Node> before(index(graph.nodes()), -1);
  using Entry = std::pair<double, Node>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  far_m[index(from)] = 0.0;
  queue.push({0.0, from});
  while (!queue.empty() && queue.top().second != to) {
    const auto [here_m, here] = queue.top();
    queue.pop();
    for (Edge e = graph.first_edge(here); here_m <= far_m[index(here)] && e < graph.end_edge(here); ++e) {
      const Node head = graph.head(e);
      if (const double m = here_m + graph.length_m(e);
          planner::in(graph.open_to(e), agent_) && m < far_m[index(head)]) {
        far_m[index(head)] = m;
        before[index(head)] = here;
        queue.push({m, head});
      }
    }
  }
  std::vector<Point> points;
  for (Node n = to; n >= 0; n = before[index(n)]) {
    points.push_back(graph.position(n));
  }
  std::reverse(points.begin(), points.end());
  return points;
}

}  // namespace ivo::firmware::rivals
