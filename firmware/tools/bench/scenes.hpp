// The maps, priors and teams of the benches, built in code or from the shipped files: two agents of 2.5 m sight at
// 1 m/s unless said otherwise (model.md, "What Table I pins down").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "config/semantic_class.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware::bench {

/// A problem and what its views point into; moved, never copied.
struct Scene {
  Scene() = default;
  Scene(Scene&&) noexcept = default;
  Scene& operator=(Scene&&) noexcept = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() = default;

  std::string name;
  std::vector<SemanticClass> pixels;
  std::vector<planner::GaussianComponent> gaussians;
  std::vector<std::int8_t> agent_of_gaussian;
  std::vector<std::uint16_t> grey;
  planner::SearchProblem problem;
};

/// Pavement of `width_m` x `height_m`; two agents, half a square from the lower corners.
[[nodiscard]] Scene open_ground(double width_m, double height_m, double pixel_m, double spacing_m);

enum class PaperMap : std::uint8_t { kM1, kM2 };
/// Table I: U uniform, G two equal Gaussians at (12, 12) and (30, 28) m, sigma 4 m (a reconstruction); with sub-priors
/// U/S half the prior each, G/S each Gaussian to the agent whose start is nearest, or exchanged.
enum class PaperPrior : std::uint8_t {
  kUniform,
  kUniformSubPriors,
  kGaussians,
  kGaussiansSubPriors,
  kGaussiansExchanged
};

/// "M1/U/S". Cells of 0.25 m. M2 is the shipped reconstruction and is refused where that is not found.
[[nodiscard]] Result<Scene> paper_scene(PaperMap map, PaperPrior prior, double spacing_m);

/// The shipped courtyard mission without its preferred areas.
[[nodiscard]] Result<Scene> courtyard_scene();

/// A Dubai mask, `folder`/dubai/tile1_1.png at 0.4 m a pixel and a cell, uniform prior: two agents
/// near the middle of the largest place that they can walk in.
[[nodiscard]] Result<Scene> dubai_scene(const std::string& folder, double spacing_m);
/// A SAREnv prior, `folder`/sarenv/1.png at 0.25 m a pixel and a cell, on open ground.
[[nodiscard]] Result<Scene> sarenv_scene(const std::string& folder);

}  // namespace ivo::firmware::bench
