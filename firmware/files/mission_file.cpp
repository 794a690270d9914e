#include "firmware/files/mission_file.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "config/limits.hpp"
#include "firmware/files/planner_capacity.hpp"
#include "firmware/files/polygon_checks.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/files/toml_table.hpp"

namespace ivo::firmware {
namespace {

constexpr Range kOnMap = {0.0, 1e5, "metres"};
constexpr std::size_t kMostGaussians = 64;

ObjectSpec read_object(const TomlValue& value) {
  if (value.is_list()) {
    return value.point(kOnMap);
  }
  if (value.present() && !value.is_text()) {
    value.complain("is no object; expected \"drawn\", \"unknown\" or [x, y]");
    return ObjectDrawn{};
  }
  return value.choice({"drawn", "unknown"}) == 0 ? ObjectSpec(ObjectDrawn{}) : ObjectSpec(ObjectUnknown{});
}

GaussianMixturePrior read_gaussians(const TomlValue& list) {
  GaussianMixturePrior prior;
  for (const TomlValue& component : list.items(1, kMostGaussians, "Gaussians")) {
    Gaussian gaussian;
    gaussian.mean = component.required("mean_m").point({-1e5, 1e5, "metres"});
    gaussian.sigma_m = component.required("sigma_m").number({0.01, 1e4, "metres"});
    gaussian.weight = component.optional("weight").number({1e-6, 1e6}, gaussian.weight);
    gaussian.agent = component.optional("agent").text();
    prior.components.push_back(gaussian);
  }
  return prior;
}

ImagePrior read_image(const TomlValue& value, const std::string& mission_path) {
  ImagePrior image;
  image.image_path = beside(mission_path, value.required("image").text());
  image.resolution_m = value.required("resolution_m").number({0.001, 100.0, "metres a pixel"});
  return image;
}

PriorSpec read_prior(const TomlValue& value, const std::string& mission_path) {
  if (!value.present()) {
    return UniformPrior{};
  }
  if (!value.is_table()) {
    if (!value.is_text() || value.text() != "uniform") {
      value.complain(
          "is no prior; expected \"uniform\", { gaussians = [...] } or { image = \"...\", resolution_m = ... }");
    }
    return UniformPrior{};
  }
  const TomlValue uniform = value.optional("uniform");
  const TomlValue gaussians = value.optional("gaussians");
  if (gaussians.present()) {
    value.refuse("uniform", "a second prior beside gaussians; expected one of the two");
    value.refuse("image", "a second prior beside gaussians; expected one of the two");
    value.refuse("resolution_m", "belongs to an image; a prior of Gaussians has none");
    return read_gaussians(gaussians);
  }
  const bool has_image = value.optional("image").present() || value.optional("resolution_m").present();
  if (uniform.present()) {
    value.refuse("image", "a second prior beside uniform; expected one of the two");
    value.refuse("resolution_m", "belongs to an image; a uniform prior has none");
    if (!uniform.flag(true)) {
      uniform.complain("is no prior; expected true, or gaussians or image in its place");
    }
    return UniformPrior{};
  }
  if (!has_image) {
    value.complain("holds no prior; expected uniform, gaussians, or image and resolution_m");
    return UniformPrior{};
  }
  return read_image(value, mission_path);
}

// Beside any prior that is a table: p/M to each.
bool read_alike(const TomlValue& prior) {
  const TomlValue value = prior.is_table() ? prior.optional("sub_priors") : prior;
  if (!prior.is_table() || !value.present()) {
    return false;
  }
  return value.choice({"alike"}) == 0;
}

PlannerParameters read_planner(const TomlValue& table) {
  PlannerParameters p;
  p.profile = static_cast<SearchProfile>(table.optional("profile").choice({"paper", "fast"}, 1));
  p.heuristic = static_cast<SearchHeuristic>(table.optional("heuristic").choice({"tsp", "mts"}));
  p.cell_m = table.optional("cell_m").number({0.01, 100.0, "metres"}, p.cell_m);
  p.spacing_m = table.optional("spacing_m").number({0.1, 1000.0, "metres"}, p.spacing_m);
  p.clearance_m = table.optional("clearance_m").number({0.0, 10.0, "metres"}, p.clearance_m);
  p.generations = static_cast<int>(table.optional("generations").integer(1, 1'000'000, p.generations));
  p.ants = static_cast<int>(table.optional("ants").integer(1, 1000, p.ants));
  p.beta = static_cast<int>(table.optional("beta").integer(0, 12, p.beta));
  if (const TomlValue rho = table.optional("rho"); rho.present()) {
    p.rho = rho.number({1e-6, 1.0}, 0.02);
  }
  p.shortest_first = table.optional("shortest_first").number({0.0, 1.0}, p.shortest_first);
  p.iteration_best = table.optional("iteration_best").number({0.0, 1.0}, p.iteration_best);
  p.max_unseen_mass = table.optional("max_unseen_mass").number({0.0, 0.5}, p.max_unseen_mass);
  return p;
}

Polygon read_rectangle(const TomlValue& value) {
  const std::vector<TomlValue> sides = value.items(4, 4, "numbers, [x0, y0, x1, y1]");
  if (sides.size() != 4) {
    return {};
  }
  const double x0 = sides[0].number(kOnMap);
  const double y0 = sides[1].number(kOnMap);
  const double x1 = sides[2].number(kOnMap, x0 + 1);
  const double y1 = sides[3].number(kOnMap, y0 + 1);
  if (x0 >= x1 || y0 >= y1) {
    value.complain("covers no area; expected [x0, y0, x1, y1] with x0 < x1 and y0 < y1");
  }
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Polygon read_polygon(const TomlValue& value) {
  Polygon polygon;
  for (const TomlValue& vertex : value.items(3, limits::kPolygonVertices, "vertices, [[x, y], ...]")) {
    polygon.push_back(vertex.point(kOnMap));
  }
  if (const std::optional<std::string> fault = polygon.empty() ? std::nullopt : fault_of(polygon)) {
    value.complain(*fault);
  }
  return polygon;
}

std::vector<Polygon> read_areas(const TomlValue& list) {
  std::vector<Polygon> areas;
  for (const TomlValue& area : list.items(0, limits::kAreas, "areas")) {
    const TomlValue rectangle = area.optional("rectangle_m");
    const TomlValue polygon = area.optional("polygon_m");
    if (area.is_table() && rectangle.present() == polygon.present()) {
      area.complain("is no area; expected either rectangle_m = [x0, y0, x1, y1] or polygon_m = [[x, y], ...]");
    }
    areas.push_back(rectangle.present() ? read_rectangle(rectangle) : read_polygon(polygon));
  }
  return areas;
}

AgentSpec read_agent(const TomlValue& table, const std::string& mission_path) {
  AgentSpec agent;
  agent.name = table.required("name").text();
  const TomlValue kind = table.required("kind");
  agent.kind = static_cast<AgentKind>(kind.choice({"robot", "person"}));
  agent.start = table.required("start_m").point(kOnMap);
  agent.speed_mps = table.required("speed_mps").number({0.05, 3.0, "metres a second"});
  agent.sight_radius_m = table.required("sight_radius_m").number({0.1, 1000.0, "metres"});
  if (agent.kind == AgentKind::kRobot) {
    agent.robot_path = beside(mission_path, table.required("robot").text());
    agent.heading_rad = table.optional("heading_deg").number({-360.0, 360.0, "degrees"}) * std::numbers::pi / 180.0;
    table.refuse("motion", "belongs to a person; a robot moves by its drives");
    table.refuse("footprint_radius_m", "belongs to a person; a robot's footprint is in its robot file");
  } else {
    agent.motion = static_cast<PersonMotion>(table.optional("motion").choice({"simulated", "reported"}));
    agent.footprint_radius_m =
        table.optional("footprint_radius_m").number({0.05, 2.0, "metres"}, agent.footprint_radius_m);
    table.refuse("robot", "belongs to a robot; a person has no robot file");
    table.refuse("heading_deg", "belongs to a robot; a person needs none");
  }
  agent.preferred = read_areas(table.optional("preferred"));
  if (const TomlValue sub_prior = table.optional("sub_prior"); sub_prior.is_table()) {
    agent.sub_prior = read_image(sub_prior, mission_path);
  } else if (sub_prior.present()) {
    sub_prior.complain("is no sub-prior; expected { image = \"...\", resolution_m = ... }");
  }
  agent.restricted = read_areas(table.optional("restricted"));
  return agent;
}

constexpr std::size_t kMostAgents = 64;  // beyond it a list is no team

std::vector<AgentSpec> read_team(const TomlValue& list, const std::string& mission_path) {
  std::vector<AgentSpec> team;
  const std::vector<TomlValue> tables = list.items(1, kMostAgents, "[[agent]] tables");
  if (tables.size() > limits::kAgents) {
    list.complain("has " + std::to_string(tables.size()) + " agents, more than this build's " +
                  std::to_string(limits::kAgents) + "; expected fewer; " +
                  profile_that_fits(static_cast<double>(tables.size()),
                                    {limits::Micro::kAgents, limits::Onboard::kAgents, limits::Desktop::kAgents}));
    return team;
  }
  for (const TomlValue& table : tables) {
    team.push_back(read_agent(table, mission_path));
    const AgentSpec& agent = team.back();
    const TomlValue kind = table.optional("kind");
    const bool first = team.size() == 1;
    if (first && kind.present() && agent.kind != AgentKind::kRobot) {
      kind.complain("the first agent is a person; expected the robot first, then persons");
    }
    if (!first && kind.present() && agent.kind == AgentKind::kRobot) {
      kind.complain("a robot after the first agent; expected exactly one robot, the first agent");
    }
    const auto same_name = [&](const AgentSpec& other) { return other.name == agent.name; };
    if (!agent.name.empty() && std::any_of(team.begin(), team.end() - 1, same_name)) {
      table.optional("name").complain("\"" + agent.name + "\" is another agent's name; expected a name of its own");
    }
  }
  return team;
}

}  // namespace

Result<MissionFile> read_mission(const std::string& path) {
  const Result<TomlFile> toml = TomlFile::read(path);
  if (!toml) {
    return toml.error();
  }
  const TomlValue root = toml.value().root();
  MissionFile file;
  file.path = path;
  Mission& mission = file.mission;
  const TomlValue format = root.required("format");
  if (format.integer(0, 1'000'000, 1) != 1) {
    format.complain("is another version of this file's form; expected 1");
  }
  mission.name = root.optional("name").text(std::filesystem::path(path).stem().string());
  mission.map_path = beside(path, root.required("map").text());
  constexpr std::int64_t kMostSeed = std::numeric_limits<std::int64_t>::max();
  mission.seed = static_cast<std::uint64_t>(root.optional("seed").integer(0, kMostSeed, 1));
  mission.object = read_object(root.optional("object"));
  mission.find = static_cast<FindRule>(root.optional("find").choice({"sight", "distance"}));
  mission.prior = read_prior(root.optional("prior"), path);
  mission.alike_sub_priors = read_alike(root.optional("prior"));
  mission.planner = read_planner(root.optional("planner"));
  mission.agents = read_team(root.required("agent"), path);
  const Result<void> finish = toml.value().finish();
  if (!finish) {
    return finish.error();
  }
  file.lines = toml.value().lines();
  return file;
}

}  // namespace ivo::firmware
