#include "firmware/tools/bench/rivals/lawnmower_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "firmware/tools/bench/rivals/best_plan.hpp"
#include "firmware/tools/bench/rivals/completion.hpp"
#include "firmware/tools/bench/rivals/lanes.hpp"

namespace ivo::firmware::rivals {
namespace {

enum class Order : std::uint8_t { kLaneByLane, kNearestPiece };

struct Setting {
  LaneSetting lanes;
  double end_gap_m = 0.0;        // how far a lane ends before what stops it
  bool shares_reversed = false;  // the agents' shares in the other order than their starts
  Order order = Order::kLaneByLane;
  unsigned corners = 0;  // lane by lane: two bits an agent, which corner of its share comes first; 0 is the nearest
};

class Lawnmower {
 public:
  explicit Lawnmower(const RivalProblem& problem) : problem_(problem) {
    for (std::size_t m = 0; m < problem.search.agents.size(); ++m) {
      ways_.emplace_back(problem, static_cast<int>(m));
    }
  }

  [[nodiscard]] Waypoints plan(const Setting& setting) {
    const std::vector<std::vector<Lane>> shares = share_out(setting);
    Waypoints all;
    for (std::size_t m = 0; m < shares.size(); ++m) {
      std::vector<LanePiece> pieces = setting.order == Order::kLaneByLane
                                          ? back_and_forth(shares[m], start(m), setting.corners >> (2 * m) & 3U)
                                          : all_pieces(shares[m]);
      all.push_back(mow(m, std::move(pieces), setting.order));
    }
    return all;
  }

 private:
  [[nodiscard]] Point start(std::size_t m) const { return problem_.search.agents[m].body.start; }

  // The lanes from one border to the other go to the agents in the order of their starts, so much to each as it sweeps
  // a second.
  [[nodiscard]] std::vector<std::vector<Lane>> share_out(const Setting& setting) {
    const std::size_t agents = ways_.size();
    std::vector<std::size_t> order(agents);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return setting.lanes.along_x ? start(a).y_m < start(b).y_m : start(a).x_m < start(b).x_m;
    });
    if (setting.shares_reversed) {
      std::reverse(order.begin(), order.end());
    }
    const auto sweeps = [&](std::size_t m) {
      return problem_.search.agents[m].speed_mps * problem_.search.agents[m].sight_radius_m;
    };
    double all_sweep = 0.0;
    for (std::size_t m = 0; m < agents; ++m) {
      all_sweep += sweeps(m);
    }
    std::vector<std::vector<Lane>> shares(agents);
    double from = 0.0;
    for (const std::size_t m : order) {
      const double to = from + sweeps(m) / all_sweep;
      const std::vector<Lane>& all = whole_lanes(m, setting.lanes);
      double whole_m = 0.0;
      for (const Lane& lane : all) {
        whole_m += length_m(lane);
      }
      double before_m = 0.0;
      for (const Lane& lane : all) {
        const double middle = (before_m + 0.5 * length_m(lane)) / std::max(whole_m, 1e-9);
        if (middle >= from && (middle < to || m == order.back()) && !lane.empty()) {
          shares[m].push_back(shortened(lane, setting.end_gap_m));
        }
        before_m += length_m(lane);
      }
      from = to;
    }
    return shares;
  }

  const std::vector<Lane>& whole_lanes(std::size_t m, const LaneSetting& setting) {
    for (const Known& known : known_) {
      if (known.agent == m && known.setting == setting) {
        return known.lanes;
      }
    }
    known_.push_back({m, setting, lanes(ways_[m], problem_.search.map, setting)});
    return known_.back().lanes;
  }

  static LanePiece turned(const LanePiece& piece) { return {piece.to, piece.from}; }

  // `corner`: bit 0 the last lane first, bit 1 its far end first, both relative to the corner nearest to `from`.
  static std::vector<LanePiece> back_and_forth(std::vector<Lane> share, Point from, unsigned corner) {
    if (share.empty()) {
      return {};
    }
    const auto near = [&](Point p) { return distance_m(from, p); };
    const Lane& first = share.front();
    const Lane& last = share.back();
    const double to_first = std::min(near(first.front().from), near(first.back().to));
    const double to_last = std::min(near(last.front().from), near(last.back().to));
    if ((to_last < to_first) != ((corner & 1U) != 0)) {
      std::reverse(share.begin(), share.end());
    }
    const Lane& lane = share.front();
    bool turn = (near(lane.back().to) < near(lane.front().from)) != ((corner & 2U) != 0);
    std::vector<LanePiece> pieces;
    for (Lane& next : share) {
      if (turn) {
        std::reverse(next.begin(), next.end());
        std::transform(next.begin(), next.end(), next.begin(), turned);
      }
      pieces.insert(pieces.end(), next.begin(), next.end());
      turn = !turn;
    }
    return pieces;
  }

  static std::vector<LanePiece> all_pieces(const std::vector<Lane>& share) {
    std::vector<LanePiece> pieces;
    for (const Lane& lane : share) {
      pieces.insert(pieces.end(), lane.begin(), lane.end());
    }
    return pieces;
  }

  // What cannot be reached is left out.
  [[nodiscard]] std::vector<Point> mow(std::size_t m, std::vector<LanePiece> pieces, Order order) const {
    std::vector<Point> points = {start(m)};
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (order == Order::kNearestPiece) {
        bring_nearest(pieces, i, points.back());
      }
      const std::optional<std::vector<Point>> way = ways_[m].way(points.back(), pieces[i].from);
      if (!way) {
        continue;
      }
      points.insert(points.end(), way->begin(), way->end());
      if (!(pieces[i].to == pieces[i].from)) {
        points.push_back(pieces[i].to);
      }
    }
    return points;
  }

  static void bring_nearest(std::vector<LanePiece>& pieces, std::size_t i, Point from) {
    std::size_t nearest = i;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t k = i; k < pieces.size(); ++k) {
      const double m = std::min(distance_m(from, pieces[k].from), distance_m(from, pieces[k].to));
      if (m < nearest_m) {
        nearest_m = m;
        nearest = k;
      }
    }
    std::swap(pieces[i], pieces[nearest]);
    if (distance_m(from, pieces[i].to) < distance_m(from, pieces[i].from)) {
      pieces[i] = turned(pieces[i]);
    }
  }

  const RivalProblem& problem_;
  std::vector<FreeWays> ways_;
  struct Known {
    std::size_t agent;
    LaneSetting setting;
    std::vector<Lane> lanes;
  };
  std::vector<Known> known_;
};

// The likely ones first: as few lanes as cover the map, evenly spaced; then one more, and the full width moved.
std::vector<Setting> settings(const RivalProblem& problem) {
  double radius_m = std::numeric_limits<double>::infinity();
  for (const planner::SearchAgent& agent : problem.search.agents) {
    radius_m = std::min(radius_m, agent.sight_radius_m);
  }
  std::vector<Setting> all;
  for (const double shift : {0.0, 1.0, -0.3, 0.3, 0.5}) {
    for (const Order order : {Order::kLaneByLane, Order::kNearestPiece}) {
      for (const double gap : {0.6, 0.0, 0.9, 0.3}) {
        for (const bool along_x : {false, true}) {
          for (const bool reversed : {false, true}) {
            const double across_m = along_x ? problem.search.map.height_m() : problem.search.map.width_m();
            const double fewest = std::ceil(across_m / (2.0 * radius_m) - 1e-9);
            const bool even = shift == 0.0 || shift == 1.0;
            const double swath_m = even ? across_m / (fewest + shift) : 2.0 * radius_m;
            const double first_m = even ? 0.5 * swath_m : (1.0 + shift) * radius_m;
            all.push_back({{along_x, swath_m, first_m}, gap * radius_m, reversed, order, 0});
          }
        }
      }
    }
  }
  return all;
}

}  // namespace

RivalPlan plan_like_a_lawnmower(const RivalProblem& problem, Effort effort, std::uint64_t /*seed*/) {
  // Candidates are judged from every fourth sight point; only what may be the best is completed and scored.
  constexpr int kStride = 4;
  constexpr double kMaybeBest = 1.01;
  const Stopwatch watch(effort);
  Lawnmower lawnmower(problem);
  const double most_unseen = problem.search.colony.ant.max_unseen_mass;
  BestPlan best(problem);
  Setting best_setting;
  double best_s = std::numeric_limits<double>::infinity();
  int tries = 0;
  const auto attempt = [&](const Setting& setting) {
    ++tries;
    const Waypoints waypoints = lawnmower.plan(setting);
    const Seen about = look_along(problem, waypoints, kStride);
    const double about_s = about.expected_time_s + std::max(0.0, about.unseen_mass - most_unseen) * about.horizon_s;
    if (about_s > best_s * kMaybeBest) {
      return;
    }
    Waypoints whole = completed(problem, waypoints);
    const bool added = whole != waypoints;
    if (best.offer(std::move(whole), added)) {
      best_s = about_s;
      best_setting = setting;
    }
  };
  for (const Setting& setting : settings(problem)) {
    if (watch.over(tries)) {
      return best.take(tries);
    }
    attempt(setting);
  }
  const Setting found = best_setting;
  const auto corners = 1U << (2 * problem.search.agents.size());
  for (Setting setting = found; ++setting.corners < corners && !watch.over(tries);) {
    setting.order = Order::kLaneByLane;
    attempt(setting);
  }
  return best.take(tries);
}

}  // namespace ivo::firmware::rivals
