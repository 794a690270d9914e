#include "tests/cross/search_cases.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "tests/support/areas.hpp"

namespace ivo::cross {
namespace {

constexpr double kPixel = 0.25;
constexpr int kWidest = 160;

using enum SemanticClass;

// The map of the case that was described last; there is no heap for it on a bare CPU.
class Canvas {
 public:
  void clear(double width_m, double height_m) noexcept {
    width_px_ = static_cast<int>(width_m / kPixel);
    height_px_ = static_cast<int>(height_m / kPixel);
    pixels_.fill(kPavement);
  }
  // The corners lie on pixels' corners.
  void put(SemanticClass c, double x0_m, double y0_m, double x1_m, double y1_m) noexcept {
    for (int row = static_cast<int>(y0_m / kPixel); row < static_cast<int>(y1_m / kPixel); ++row) {
      for (int column = static_cast<int>(x0_m / kPixel); column < static_cast<int>(x1_m / kPixel); ++column) {
        pixels_[static_cast<std::size_t>(row * width_px_ + column)] = c;
      }
    }
  }
  [[nodiscard]] planner::SegmentedMap view() const noexcept {
    const auto count = static_cast<std::size_t>(width_px_ * height_px_);
    return {.pixels = {pixels_.data(), count},
            .width_px = width_px_,
            .height_px = height_px_,
            .resolution_m = kPixel,
            .classes = default_class_table()};
  }

 private:
  int width_px_ = 0;
  int height_px_ = 0;
  std::array<SemanticClass, kWidest * kWidest> pixels_{};
};

Canvas canvas;

constexpr std::array<planner::GaussianComponent, 2> kTwoGaussians = {
    {{.mean = {12.0, 12.0}, .sigma_m = 4.0, .weight = 1.0}, {.mean = {30.0, 28.0}, .sigma_m = 4.0, .weight = 1.0}}};

void place_agents(planner::SearchProblem& problem, Point first, Point second, double speed_mps) noexcept {
  problem.agents.resize(2);
  problem.agents[0] = {};
  problem.agents[1] = {};
  problem.agents[0].body.start = first;
  problem.agents[1].body.start = second;
  problem.agents[0].speed_mps = speed_mps;
  problem.agents[1].speed_mps = speed_mps;
}

void describe_m1_uniform(planner::SearchProblem& problem) noexcept {
  canvas.clear(40.0, 40.0);
  problem.graph.spacing_m = 5.0;
  place_agents(problem, {2.5, 2.5}, {37.5, 2.5}, 1.0);
}

void describe_m1_two_gaussians(planner::SearchProblem& problem) noexcept {
  canvas.clear(40.0, 40.0);
  problem.graph.spacing_m = 3.5;
  place_agents(problem, {1.75, 1.75}, {39.25, 1.75}, 1.0);
  problem.prior = std::span<const planner::GaussianComponent>(kTwoGaussians);
}

// Walls, a hedge, a pond that hides nothing, and stairs that only the person may take; speeds that no binary fraction
// holds.
void describe_courtyard(planner::SearchProblem& problem) noexcept {
  canvas.clear(24.0, 21.0);
  canvas.put(kWall, 6.0, 4.0, 6.5, 17.0);
  canvas.put(kBuilding, 11.0, 8.0, 16.5, 12.75);
  canvas.put(kShrub, 18.0, 2.0, 21.5, 2.75);
  canvas.put(kWater, 14.0, 15.0, 19.0, 18.25);
  canvas.put(kStairs, 6.0, 18.5, 7.5, 21.0);
  canvas.put(kTree, 9.0, 18.0, 9.75, 18.75);
  problem.cell_m = 0.25;
  problem.graph.spacing_m = 3.0;
  place_agents(problem, {1.3, 1.7}, {22.1, 19.3}, 0.45);
  problem.agents[1].body.kind = AgentKind::kPerson;
  problem.agents[1].speed_mps = 0.7;
}

void describe_sub_priors(planner::SearchProblem& problem) noexcept {
  describe_courtyard(problem);
  (void)problem.agents[0].preferred.push_back(test::rectangle(7.0, 0.0, 24.0, 7.0));
  (void)problem.agents[1].preferred.push_back(test::rectangle(0.0, 9.0, 10.0, 21.0));
  problem.colony.seed = 20;
}

// Discs too wide for the improvement: hundreds of rows an edge.
void describe_wide_sight(planner::SearchProblem& problem) noexcept {
  describe_m1_two_gaussians(problem);
  problem.cell_m = 0.25;
  problem.graph.spacing_m = 6.0;
  place_agents(problem, {3.0, 3.0}, {37.0, 3.0}, 1.0);
  canvas.put(kWall, 20.0, 14.0, 20.5, 26.0);
  for (planner::SearchAgent& agent : problem.agents) {
    agent.sight_radius_m = 12.0;
  }
  problem.colony.generations = 2;
}

void describe_sectors(planner::SearchProblem& problem) noexcept {
  describe_courtyard(problem);
  problem.colony.profile = planner::Profile::kPaper;
  problem.colony.heuristic = planner::Heuristic::kMts;
  problem.colony.generations = 4;
}

struct NamedCase {
  std::string_view name;
  void (*describe)(planner::SearchProblem&) noexcept;
};
constexpr std::array<NamedCase, kCases> kAll = {{{"m1 uniform", describe_m1_uniform},
                                                 {"m1 two gaussians", describe_m1_two_gaussians},
                                                 {"courtyard", describe_courtyard},
                                                 {"courtyard, sub-priors", describe_sub_priors},
                                                 {"wide sight", describe_wide_sight},
                                                 {"courtyard, sectors", describe_sectors}}};

}  // namespace

std::string_view case_name(int number) noexcept { return kAll[static_cast<std::size_t>(number)].name; }

void describe_case(int number, planner::SearchProblem& problem) noexcept {
  problem = {};
  problem.cell_m = 0.5;
  problem.colony.generations = 8;
  problem.colony.seed = 2024;
  kAll[static_cast<std::size_t>(number)].describe(problem);
  problem.map = canvas.view();
}

}  // namespace ivo::cross
