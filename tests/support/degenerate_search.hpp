// Searches drawn at random from what nobody should ask for: maps of a few pixels or all wall, cells and squares larger
// than the map or far too small, reaches and footprints of nothing or of kilometres, agents on one spot or off the map,
// priors of one pixel or none.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "planner/search/planner.hpp"
#include "tests/support/areas.hpp"

namespace ivo::test {

class DegenerateSearch {
 public:
  explicit DegenerateSearch(std::mt19937_64& random) : random_(random) {
    draw_map();
    problem_.cell_m = one_of({0.25, 0.25, 0.5, 0.1, 1.0, 7.0, 1000.0, 0.001});
    problem_.graph.spacing_m = one_of({0.5, 1.0, 2.0, 2.0, 3.5, 50.0, 0.01, 9e5, 1e12});
    problem_.graph.clearance_m = one_of({0.0, 0.1, 0.4, 0.4, 30.0, 1e300});
    draw_prior();
    const int agents = 1 + below(limits::kAgents);
    const Point together = somewhere();
    for (int m = 0; m < agents; ++m) {
      problem_.agents.resize(static_cast<std::size_t>(m) + 1);
      draw_agent(problem_.agents[static_cast<std::size_t>(m)], together);
    }
    keep_it_short();
    problem_.colony.generations = 1 + below(3);
    problem_.colony.ants = 1 + below(3);
    problem_.colony.beta = below(12);
    problem_.colony.rho = one_of({0.002, 0.5, 1.0, 1e-9});
    problem_.colony.iteration_best = one_of({0.0, 0.5, 1.0});
    problem_.colony.seed = random_();
    problem_.colony.ant.shortest_first = one_of({0.0, 0.9, 1.0});
    problem_.colony.ant.max_unseen_mass = one_of({0.0, 0.014, 0.5, 1.0});
  }
  DegenerateSearch(const DegenerateSearch&) = delete;
  DegenerateSearch& operator=(const DegenerateSearch&) = delete;

  [[nodiscard]] planner::SearchProblem& problem() { return problem_; }

 private:
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  bool chance(double p) { return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < p; }
  double one_of(std::initializer_list<double> values) { return values.begin()[below(static_cast<int>(values.size()))]; }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  // Also on lines between pixels, on the border and beyond it.
  Point somewhere() {
    const double width_m = problem_.map.width_m();
    const double height_m = problem_.map.height_m();
    if (chance(0.03)) {
      return {one_of({-1.0, 0.0, width_m, width_m / 2, 1e9}), one_of({-1e-12, 0.0, height_m, height_m / 2, -1e9})};
    }
    if (chance(0.4)) {
      const double size = problem_.map.resolution_m;
      return {below(problem_.map.width_px + 1) * size, below(problem_.map.height_px + 1) * size};
    }
    return {between(0.0, width_m), between(0.0, height_m)};
  }

  void draw_map() {
    const bool speck = chance(0.2);
    const int width_px = 1 + below(speck ? 3 : 40);
    const int height_px = 1 + below(speck ? 3 : 40);
    pixels_.assign(static_cast<std::size_t>(width_px * height_px), SemanticClass::kPavement);
    const double full = one_of({0.0, 0.0, 0.0, 0.02, 0.02, 0.1, 0.5, 1.0});
    for (SemanticClass& pixel : pixels_) {
      if (chance(full)) {
        pixel = static_cast<SemanticClass>(below(static_cast<int>(kClasses)));
      }
    }
    if (full == 1.0 && chance(0.5)) {
      pixels_.assign(pixels_.size(), chance(0.5) ? SemanticClass::kBuilding : SemanticClass::kWater);
    }
    problem_.map = {pixels_, width_px, height_px, one_of({0.25, 0.25, 0.3, 0.01, 1.0}), default_class_table()};
  }

  void draw_prior() {
    if (chance(0.4)) {
      const int components = below(3);  // of none there is no mass
      for (int i = 0; i < components; ++i) {
        gaussians_.push_back({somewhere(), one_of({1e-6, 0.01, 1.0, 1e6}), one_of({0.0, 1e-300, 1.0, 1e300})});
      }
      problem_.prior = std::span<const planner::GaussianComponent>(gaussians_);
    } else if (chance(0.5)) {
      const int width_px = 1 + below(6);
      const int height_px = 1 + below(6);
      image_.assign(static_cast<std::size_t>(width_px * height_px), 0);
      if (chance(0.8)) {
        image_[static_cast<std::size_t>(below(width_px * height_px))] = chance(0.5) ? 1 : 65535;
      }
      problem_.prior = planner::GreyView{image_, width_px, height_px, one_of({0.01, 0.25, 3.0, 500.0})};
    }
  }

  void draw_agent(planner::SearchAgent& agent, Point together) {
    agent.body.start = chance(0.4) ? together : somewhere();
    agent.body.kind = chance(0.5) ? AgentKind::kPerson : AgentKind::kRobot;
    agent.body.footprint_radius_m = one_of({0.0, 0.0, 0.01, 0.01, 0.1, 0.3, chance(0.1) ? 40.0 : 0.0});
    agent.speed_mps = one_of({0.5, 1.0, 1e-3, 100.0, 1e9});
    agent.sight_radius_m = one_of({0.0, 0.1, 1.0, 2.5, 2.5, 500.0, 1e7});
    for (int i = 0; i < limits::kAreas && chance(0.15); ++i) {
      (void)agent.body.restricted.push_back(area());
    }
    for (int i = 0; i < limits::kAreas && chance(0.08); ++i) {
      (void)agent.preferred.push_back(area());
    }
  }

  // A large search is not degenerate, only long: cells and squares grow until the sight points of all edges together
  // look at few cells. What is over a capacity stays so.
  void keep_it_short() {
    constexpr double kMostLooks = 4e5;
    const double width_m = problem_.map.width_m();
    const double height_m = problem_.map.height_m();
    double reach_m = 0.0;
    for (const planner::SearchAgent& agent : problem_.agents) {
      reach_m = std::max(reach_m, agent.sight_radius_m);
    }
    while (true) {
      double& cell_m = problem_.cell_m;
      double& spacing_m = problem_.graph.spacing_m;
      const double cells = std::ceil(width_m / cell_m) * std::ceil(height_m / cell_m);
      const double squares = std::ceil(width_m / spacing_m) * std::ceil(height_m / spacing_m);
      const double edges = squares * std::min(24.0, squares);
      const double points = 2.0 * std::min(4.0 * spacing_m, width_m + height_m) / cell_m + 1.0;
      const double looks = edges * points * std::min(cells, 4.0 * reach_m * reach_m / (cell_m * cell_m) + 9.0);
      if (cells > limits::kCells || squares > 2.0 * limits::kNodes || looks <= kMostLooks) {
        return;
      }
      cell_m *= 1.2;
      spacing_m *= 1.2;
    }
  }

  // Overlapping as they come; some without extent.
  planner::Area area() {
    const Point a = somewhere();
    const Point b = chance(0.2) ? a : somewhere();
    return rectangle(a.x_m, a.y_m, b.x_m, b.y_m);
  }

  std::mt19937_64& random_;
  std::vector<SemanticClass> pixels_;
  std::vector<planner::GaussianComponent> gaussians_;
  std::vector<std::uint16_t> image_;
  planner::SearchProblem problem_;
};

}  // namespace ivo::test
