#include "firmware/tools/bench/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "firmware/files/grey_image.hpp"
#include "firmware/files/map_file.hpp"
#include "firmware/files/png_file.hpp"
#include "firmware/tools/bench/walkable.hpp"
#include "firmware/tools/planner_setup.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr double kSpeed_mps = 1.0;
constexpr double kSight_m = 2.5;

void add_agent(Scene& scene, Point start) {
  planner::SearchAgent agent;
  agent.body.start = start;
  agent.speed_mps = kSpeed_mps;
  agent.sight_radius_m = kSight_m;
  (void)scene.problem.agents.push_back(agent);
}

/// The middle of the first and of the last square of the lowest row (M1 at 3.5 m: x 1.75 and 39.25), not too near the
/// border.
void add_corner_agents(Scene& scene, double width_m, double spacing_m) {
  const double last_m = (std::ceil(width_m / spacing_m - 1e-9) - 1) * spacing_m;
  add_agent(scene, {0.5 * spacing_m, 0.5 * spacing_m});
  add_agent(scene, {std::min(0.5 * (last_m + width_m), width_m - 0.75), 0.5 * spacing_m});
}

void set_map(Scene& scene, int width_px, int height_px, double resolution_m, const ClassTable& classes) {
  scene.problem.map = {scene.pixels, width_px, height_px, resolution_m, classes};
}

/// A shipped file: as seen from the checkout's top, or from the program in build/PRESET.
std::string shipped(const std::string& path) {
  std::error_code status;
  if (std::filesystem::exists(path, status)) {
    return path;
  }
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", status);
  return (program.parent_path().parent_path().parent_path() / path).string();
}

Result<Scene> paper_ground(PaperMap map, double spacing_m) {
  constexpr double kSide_m = 40.0;
  if (map == PaperMap::kM1) {
    return open_ground(kSide_m, kSide_m, 0.25, spacing_m);
  }
  Result<MapFile> file = read_map(shipped("config/maps/m2.toml"));
  if (!file) {
    return file.error();
  }
  Scene scene;
  scene.pixels = std::move(file.value().pixels);
  set_map(scene, file.value().width_px, file.value().height_px, file.value().resolution_m, file.value().classes);
  scene.problem.graph.spacing_m = spacing_m;
  add_corner_agents(scene, kSide_m, spacing_m);
  return scene;
}

}  // namespace

Scene open_ground(double width_m, double height_m, double pixel_m, double spacing_m) {
  Scene scene;
  const int width_px = static_cast<int>(std::lround(width_m / pixel_m));
  const int height_px = static_cast<int>(std::lround(height_m / pixel_m));
  scene.pixels.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                      SemanticClass::kPavement);
  set_map(scene, width_px, height_px, pixel_m, default_class_table());
  scene.problem.cell_m = pixel_m;
  scene.problem.graph.spacing_m = spacing_m;
  add_corner_agents(scene, width_m, spacing_m);
  return scene;
}

Result<Scene> paper_scene(PaperMap map, PaperPrior prior, double spacing_m) {
  Result<Scene> ground = paper_ground(map, spacing_m);
  if (!ground) {
    return ground;
  }
  Scene scene = std::move(ground).value();
  scene.name = map == PaperMap::kM1 ? "M1" : "M2";
  scene.gaussians = {{{12.0, 12.0}, 4.0, 1.0}, {{30.0, 28.0}, 4.0, 1.0}};
  planner::SearchProblem& problem = scene.problem;
  const std::span<const planner::GaussianComponent> both = scene.gaussians;
  const std::array<Point, 2> starts = {problem.agents[0].body.start, problem.agents[1].body.start};
  for (const planner::GaussianComponent& component : both) {
    const std::int8_t nearest = planner::nearest_agent(component, starts);
    const bool exchanged = prior == PaperPrior::kGaussiansExchanged;
    scene.agent_of_gaussian.push_back(exchanged ? static_cast<std::int8_t>(1 - nearest) : nearest);
  }
  switch (prior) {
    case PaperPrior::kUniform:
      scene.name += "/U";
      break;
    case PaperPrior::kUniformSubPriors:
      scene.name += "/U/S";
      problem.sub_priors = planner::AlikeSubPriors{};
      break;
    case PaperPrior::kGaussians:
      scene.name += "/G";
      problem.prior = both;
      break;
    case PaperPrior::kGaussiansSubPriors:
      scene.name += "/G/S";
      problem.prior = both;
      problem.sub_priors = planner::DealtComponents{scene.agent_of_gaussian};
      break;
    case PaperPrior::kGaussiansExchanged:
      scene.name += "/G/S exchanged";
      problem.prior = both;
      problem.sub_priors = planner::DealtComponents{scene.agent_of_gaussian};
      break;
  }
  return scene;
}

Result<Scene> courtyard_scene() {
  Result<MissionInputs> read = read_inputs(shipped("config/missions/courtyard.toml"));
  if (!read) {
    return read.error();
  }
  MissionInputs inputs = std::move(read).value();
  Scene scene;
  scene.name = "courtyard";
  scene.problem = inputs.problem();
  scene.pixels = std::move(inputs.map.pixels);
  scene.problem.map.pixels = scene.pixels;
  scene.gaussians = std::move(inputs.gaussians);
  scene.problem.prior = std::span<const planner::GaussianComponent>(scene.gaussians);
  for (planner::SearchAgent& agent : scene.problem.agents) {
    agent.preferred.clear();
  }
  return scene;
}

Result<Scene> dubai_scene(const std::string& folder, double spacing_m) {
  constexpr double kPixel_m = 0.4;
  const Result<ColourImage> image = read_colours(folder + "/dubai/tile1_1.png");
  if (!image) {
    return image.error();
  }
  const std::pair<Colour, SemanticClass> kClassesThere[] = {
      {{60, 16, 152}, SemanticClass::kBuilding}, {{132, 41, 246}, SemanticClass::kSoil},
      {{110, 193, 228}, SemanticClass::kRoad},   {{254, 221, 58}, SemanticClass::kGrass},
      {{226, 169, 41}, SemanticClass::kWater},   {{155, 155, 155}, SemanticClass::kPavement}};
  Scene scene;
  scene.name = "Dubai tile 1_1";
  for (const Colour colour : image.value().pixels) {
    SemanticClass there = SemanticClass::kPavement;
    for (const auto& [known, meaning] : kClassesThere) {
      there = known == colour ? meaning : there;
    }
    scene.pixels.push_back(there);
  }
  set_map(scene, image.value().width_px, image.value().height_px, kPixel_m, default_class_table());
  scene.problem.cell_m = kPixel_m;
  scene.problem.graph.spacing_m = spacing_m;
  const planner::SegmentedMap& map = scene.problem.map;
  const Walkable walkable(map, 0.6);
  for (const double share : {0.4, 0.6}) {
    add_agent(scene, walkable.nearest({share * map.width_m(), 0.5 * map.height_m()}));
  }
  return scene;
}

Result<Scene> sarenv_scene(const std::string& folder) {
  constexpr double kPixel_m = 0.25;
  Result<GreyImage> image = read_grey(folder + "/sarenv/1.png");
  if (!image) {
    return image.error();
  }
  Scene scene = open_ground(image.value().width_px * kPixel_m, image.value().height_px * kPixel_m, kPixel_m, 3.5);
  scene.name = "SAREnv 1";
  scene.grey = std::move(image.value().values);
  scene.problem.prior = planner::GreyView{scene.grey, image.value().width_px, image.value().height_px, kPixel_m};
  return scene;
}

}  // namespace ivo::firmware::bench
