// Searches of nearly as many cells as the default profile has room for, and plans for them: lanes, since planning there
// takes minutes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "planner/search/planner.hpp"
#include "planner/world/graph_table.hpp"
#include "tests/support/areas.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::cross {

enum class LargePrior : std::uint8_t {
  kUniform,
  kFarGaussian,   ///< of 5 m, in the corner farthest from both starts
  kTwoGaussians,  ///< the same, and one of 20 m near a start: found more than an hour apart
  kSpot,          ///< an image: half near a start, the rest even; by as much as half a unit of a thousand rounded
  kSteps,         ///< an image of few levels
};
enum class LargeSubPriors : std::uint8_t { kNone, kAlike, kDealt, kPreferredByOne, kPreferredByBoth };

struct LargeRow {
  const char* name = "";
  double side_m = 360.0;  ///< at 0.4 m cells
  LargePrior prior = LargePrior::kUniform;
  LargeSubPriors sub_priors = LargeSubPriors::kNone;
};

/// Owns what the problem's views point into.
class LargeCase {
 public:
  explicit LargeCase(const LargeRow& row) : row_(row), map_(row.side_m, row.side_m, kCell_m) {
    problem_.map = map_.view();
    problem_.cell_m = kCell_m;
    problem_.agents.resize(2);
    for (planner::SearchAgent& agent : problem_.agents) {
      agent.sight_radius_m = kSight_m;
    }
    problem_.agents[0].speed_mps = 1.6;
    problem_.agents[1].speed_mps = 1.3;
    const int side = static_cast<int>(row.side_m / kSpacing_m + 0.5);
    make_graph(side, row.prior == LargePrior::kFarGaussian ? 2 : side - 1);
    choose_prior();
    choose_sub_priors();
  }
  LargeCase(const LargeCase&) = delete;
  LargeCase& operator=(const LargeCase&) = delete;

  [[nodiscard]] const planner::SearchProblem& problem() const { return problem_; }

  /// Waypoints of each agent: lanes over its half of the map, or straight to its half of the Gaussian's middle.
  [[nodiscard]] std::vector<std::vector<Point>> ways() const {
    if (row_.prior == LargePrior::kFarGaussian) {
      const Point mean = gaussians_.back().mean;
      constexpr double kMiddle_m = 15.0;
      return {lanes(0, {mean.x_m - kMiddle_m, mean.y_m - kMiddle_m}, {mean.x_m, mean.y_m + kMiddle_m}),
              lanes(1, {mean.x_m + kMiddle_m, mean.y_m - kMiddle_m}, {mean.x_m, mean.y_m + kMiddle_m})};
    }
    const double far_m = row_.side_m - kSight_m;
    return {lanes(0, {kSight_m, kSight_m}, {row_.side_m / 2 - kSight_m, far_m}),
            lanes(1, {far_m, kSight_m}, {row_.side_m / 2 + kSight_m, far_m})};
  }

 private:
  static constexpr double kCell_m = 0.4;
  static constexpr double kSight_m = 4.0;
  static constexpr double kSpacing_m = 2.0 * kSight_m;

  // A grid of `side` by `side` nodes with four neighbours each, which is all that must be seen; the sight of a graph
  // that is built takes most of a minute. The agents start in the lowest row, in the first column and in another.
  void make_graph(int side, int second_start) {
    const auto node_at = [&](int column, int row) {  // the agents' starts are nodes 0 and 1
      const int number = row * side + column;
      return number == 1 ? second_start : number == second_start ? 1 : number;
    };
    const auto inside = [&](int i) { return i >= 0 && i < side; };
    for (int n = 0; n < side * side; ++n) {
      const int number = n == 1 ? second_start : n == second_start ? 1 : n;
      const int column = number % side;
      const int row = number / side;
      positions_.push_back({kSight_m + column * kSpacing_m, kSight_m + row * kSpacing_m});
      first_edge_.push_back(static_cast<planner::Edge>(heads_.size()));
      for (const auto& [x, y] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
        if (inside(column + x) && inside(row + y)) {
          heads_.push_back(node_at(column + x, row + y));
        }
      }
      std::sort(heads_.begin() + first_edge_.back(), heads_.end());
    }
    first_edge_.push_back(static_cast<planner::Edge>(heads_.size()));
    open_to_.assign(heads_.size(), planner::AgentSet{3});
    graph_ = {.spacing_m = kSpacing_m,
              .agents = 2,
              .positions = positions_,
              .first_edge = first_edge_,
              .heads = heads_,
              .open_to = open_to_};
    problem_.graph_table = &graph_;
    problem_.agents[0].body.start = positions_[0];
    problem_.agents[1].body.start = positions_[1];
  }

  void choose_prior() {
    const planner::GaussianComponent far{{row_.side_m - 40.0, row_.side_m - 30.0}, 5.0, 1.0};
    if (row_.prior == LargePrior::kFarGaussian) {
      gaussians_ = {far};
    } else if (row_.prior == LargePrior::kTwoGaussians) {
      gaussians_ = {{{60.0, 50.0}, 20.0, 1.0}, far};
    } else if (row_.prior == LargePrior::kSpot) {
      spot_.assign(400, 1);
      spot_[0] = 392;
      problem_.prior = planner::GreyView{spot_, 20, 20, row_.side_m / 20};
    } else if (row_.prior == LargePrior::kSteps) {
      problem_.prior = planner::GreyView{kLevels, 4, 4, row_.side_m / 4};
    }
    if (!gaussians_.empty()) {
      problem_.prior = std::span<const planner::GaussianComponent>(gaussians_);
    }
  }

  void choose_sub_priors() {
    const double half_m = row_.side_m / 2;
    switch (row_.sub_priors) {
      case LargeSubPriors::kNone:
        break;
      case LargeSubPriors::kAlike:
        problem_.sub_priors = planner::AlikeSubPriors{};
        break;
      case LargeSubPriors::kDealt:
        problem_.sub_priors = planner::DealtComponents{kDealt};
        break;
      case LargeSubPriors::kPreferredByBoth:
        (void)problem_.agents[0].preferred.push_back(test::rectangle(0.0, 0.0, half_m, 0.6 * half_m));
        [[fallthrough]];
      case LargeSubPriors::kPreferredByOne:
        (void)problem_.agents[1].preferred.push_back(test::rectangle(2 * half_m - 49.6, 0.0, 2 * half_m, 50.0));
        break;
    }
  }

  // From `first` to the opposite corner `last` along x, the lanes a little closer than two radii.
  [[nodiscard]] std::vector<Point> lanes(std::size_t agent, Point first, Point last) const {
    constexpr double kBetween_m = 1.9 * kSight_m;
    std::vector<Point> way = {problem_.agents[agent].body.start};
    bool there = false;
    for (double y_m = first.y_m; y_m <= last.y_m; y_m += kBetween_m) {
      way.push_back({there ? last.x_m : first.x_m, y_m});
      there = !there;
      way.push_back({there ? last.x_m : first.x_m, y_m});
    }
    return way;
  }

  static constexpr std::array<std::uint16_t, 16> kLevels = {3, 3, 1, 1, 3, 2, 1, 1, 2, 2, 2, 5, 1, 1, 5, 5};
  static constexpr std::array<std::int8_t, 2> kDealt = {0, 1};

  LargeRow row_;
  test::DrawnMap map_;
  std::vector<Point> positions_;
  std::vector<planner::Edge> first_edge_;
  std::vector<planner::Node> heads_;
  std::vector<planner::AgentSet> open_to_;
  planner::GraphTable graph_;
  std::vector<planner::GaussianComponent> gaussians_;
  std::vector<std::uint16_t> spot_;
  planner::SearchProblem problem_;
};

}  // namespace ivo::cross
