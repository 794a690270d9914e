// Small searches drawn at random: a map with things that hide, things that only block and stairs that only people
// climb; one to four agents of different sizes, speeds and reaches, some with areas that they must not enter or would
// rather search; a prior of each kind. Some are refused (a start in a wall, an area over water): the caller draws
// again.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "planner/search/planner.hpp"
#include "tests/support/areas.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::test {

class RandomSearch {
 public:
  explicit RandomSearch(std::mt19937_64& random)
      : random_(random), height_m_(between(6.0, 11.0)), map_(between(7.0, 15.0), height_m_, 0.25) {
    draw_map();
    problem_.map = map_.view();
    problem_.cell_m = chance(0.5) ? 0.5 : 0.25;
    problem_.graph.spacing_m = between(1.8, 3.0);
    draw_prior();
    const std::size_t agents = std::min<std::size_t>(1 + random_() % 4, limits::kAgents);
    const bool preferences = chance(0.6);
    for (std::size_t m = 0; m < agents; ++m) {
      problem_.agents.resize(m + 1);
      draw_agent(problem_.agents[m], preferences);
    }
    problem_.colony.generations = 3;
    problem_.colony.ants = 4;
    problem_.colony.seed = random_();
    problem_.colony.ant.shortest_first = between(0.5, 1.0);
    problem_.colony.ant.max_unseen_mass = chance(0.6) ? 0.014 : between(0.0, 0.4);
  }
  RandomSearch(const RandomSearch&) = delete;
  RandomSearch& operator=(const RandomSearch&) = delete;

  [[nodiscard]] planner::SearchProblem& problem() { return problem_; }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double p) { return between(0.0, 1.0) < p; }
  // One draw a statement: compilers differ in the order of a call's arguments.
  Point size_between(double least_m, double most_m) {
    const double height_m = between(least_m, most_m);
    return {between(least_m, most_m), height_m};
  }
  Point anywhere() { return {between(0.0, map_.view().width_m()), between(0.0, map_.view().height_m())}; }

  void draw_map() {
    constexpr std::array<SemanticClass, 5> kThings = {SemanticClass::kBuilding, SemanticClass::kTree,
                                                      SemanticClass::kWater, SemanticClass::kStreetFurniture,
                                                      SemanticClass::kStairs};
    for (int i = 0; i < 6; ++i) {
      const Point p = anywhere();
      const Point size = size_between(0.3, 2.0);
      map_.put(kThings[random_() % kThings.size()], p.x_m, p.y_m, p.x_m + size.x_m, p.y_m + size.y_m);
    }
  }

  void draw_prior() {
    if (chance(0.35)) {
      gaussians_ = {{anywhere(), between(0.8, 3.0), 1.0}, {anywhere(), between(0.8, 3.0), 2.0}};
      problem_.prior = std::span<const planner::GaussianComponent>(gaussians_);
    } else if (chance(0.45)) {
      const planner::SegmentedMap map = map_.view();
      const double resolution_m = between(0.2, 1.3);
      const int width_px = 1 + static_cast<int>(map.width_m() * between(0.6, 1.1) / resolution_m);
      const int height_px = 1 + static_cast<int>(map.height_m() * between(0.6, 1.1) / resolution_m);
      image_.resize(static_cast<std::size_t>(width_px * height_px));
      for (std::uint16_t& value : image_) {
        value = chance(0.4) ? std::uint16_t{0} : static_cast<std::uint16_t>(random_() % 65536);
      }
      problem_.prior = planner::GreyView{image_, width_px, height_px, resolution_m};
    }
  }

  void draw_agent(planner::SearchAgent& agent, bool preferences) {
    agent.body.start = anywhere();
    agent.body.kind = chance(0.5) ? AgentKind::kPerson : AgentKind::kRobot;
    agent.speed_mps = chance(0.3) ? 0.5 : between(0.3, 1.5);
    agent.sight_radius_m = chance(0.5) ? 2.0 : between(0.6, 3.5);
    agent.body.footprint_radius_m = chance(0.4) ? 0.30 : between(0.05, 0.45);
    for (int i = 0; i < 2 && chance(0.3); ++i) {
      const Point p = anywhere();
      const Point size = size_between(0.2, 3.0);
      (void)agent.body.restricted.push_back(rectangle(p.x_m, p.y_m, p.x_m + size.x_m, p.y_m + size.y_m));
    }
    for (int i = 0; preferences && i < 2 && chance(0.5); ++i) {
      const Point p = anywhere();
      (void)agent.preferred.push_back(rectangle(p.x_m, p.y_m, p.x_m + 4.0, p.y_m + 3.0));
    }
  }

  std::mt19937_64& random_;
  double height_m_;
  DrawnMap map_;
  std::vector<planner::GaussianComponent> gaussians_;
  std::vector<std::uint16_t> image_;
  planner::SearchProblem problem_;
};

}  // namespace ivo::test
