#include "firmware/tools/planner_setup.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "firmware/files/number_text.hpp"
#include "firmware/files/robot_file.hpp"
#include "firmware/tools/beyond_capacity.hpp"
#include "firmware/tools/invalid_problem.hpp"

namespace ivo::firmware {
namespace {

planner::Areas areas_of(const std::vector<Polygon>& polygons) {
  planner::Areas areas;
  for (const Polygon& polygon : polygons) {
    areas.resize(areas.size() + 1);
    areas.back().clear();
    for (const Point vertex : polygon) {
      IVO_CONTRACT(areas.back().push_back(vertex));  // the reader refuses larger polygons
    }
  }
  return areas;
}

constexpr double kPaperRho = 0.002;
constexpr double kFastRho = 0.02;

std::string metres(double value) { return shortest(std::round(value * 100) / 100) + " m"; }

}  // namespace

Error sentence_of(const planner::Refusal& refusal, const MissionInputs& inputs) {
  using planner::RefusalCode;
  const Lines& lines = inputs.file.lines;
  const Mission& mission = inputs.file.mission;
  const std::string agent_key = "agent[" + std::to_string(refusal.agent) + "]";
  const AgentSpec* agent = refusal.agent >= 0 ? &mission.agents[static_cast<std::size_t>(refusal.agent)] : nullptr;
  switch (refusal.code) {
    case RefusalCode::kNoGraphTable:
      return {"this build of the planner cannot prove edges free; expected a graph made by one with libccd"};
    case RefusalCode::kGraphTableUnfit:
      return {"the graph given to the planner does not fit the mission; expected one built for its agents"};
    case RefusalCode::kTooManyNeighbours:
      return {"a node of the graph given to the planner has " + shortest(refusal.value) +
              " neighbours; expected at most " + shortest(refusal.limit)};
    case RefusalCode::kStartOutsideMap:
      return lines.at(agent_key + ".start_m", shortest(agent->start) + " is outside the map; expected 0 to " +
                                                  shortest(inputs.map.view().width_m()) + ", 0 to " +
                                                  shortest(inputs.map.view().height_m()) + " (metres)");
    case RefusalCode::kStartBlocked:
      return lines.at(agent_key + ".start_m", refusal.value <= 0
                                                  ? shortest(agent->start) +
                                                        " is inside an obstacle; expected a free place with " +
                                                        metres(refusal.limit) + " around it"
                                                  : shortest(agent->start) + " is " + metres(refusal.value) +
                                                        " from an obstacle or the border; expected at least " +
                                                        metres(refusal.limit) + ", the footprint's radius");
    case RefusalCode::kStartRestricted:
      return lines.at(agent_key + ".start_m", shortest(agent->start) + " is where " + agent->name +
                                                  " may not be; expected a start outside restricted classes and areas");
    case RefusalCode::kPriorWithoutMass:
      return lines.at("prior", "holds no mass on any free cell of the map; expected some where an object may lie");
    case RefusalCode::kNoMassObservable:
      return lines.at(
          agent_key + ".start_m",
          agent->name +
              " sees no place that may hold the object from anywhere it can go; expected a start from which it can");
    case RefusalCode::kAreaWithoutMass:
      return lines.at(
          agent_key + ".preferred[" + std::to_string(refusal.area) + "]",
          "covers nothing that may hold the object and that " + agent->name + " can see; expected an area that does");
    case RefusalCode::kSubPriorsTwice:
      return lines.at(agent_key + ".preferred",
                      "preferred areas beside sub-priors that are given; expected one of the two");
    case RefusalCode::kPriorNotFinite:
      return lines.at(agent != nullptr ? agent_key + ".sub_prior" : "prior",
                      "holds a mass of " + (std::isnan(refusal.value) ? "nan" : shortest(refusal.value)) +
                          "; expected finite numbers, 0 or more");
    default:
      break;
  }
  const std::optional<Error> beyond = beyond_capacity(refusal, lines);
  return beyond ? *beyond : invalid_problem(refusal, lines);
}

planner::SearchProblem MissionInputs::problem() const {
  const Mission& mission = file.mission;
  planner::SearchProblem problem;
  problem.map = map.view();
  problem.cell_m = mission.planner.cell_m;
  problem.graph = {.spacing_m = mission.planner.spacing_m, .clearance_m = mission.planner.clearance_m};
  if (prior_image) {
    problem.prior = planner::GreyView{prior_image->values, prior_image->width_px, prior_image->height_px,
                                      std::get<ImagePrior>(mission.prior).resolution_m};
  } else if (!gaussians.empty()) {
    problem.prior = std::span<const planner::GaussianComponent>(gaussians);
  }
  problem.sub_priors = sub_priors.choice();
  for (const AgentSpec& spec : mission.agents) {
    planner::SearchAgent agent;
    agent.body = {
        .start = spec.start,
        .kind = spec.kind,
        .footprint_radius_m = spec.kind == AgentKind::kRobot ? robot.footprint_radius_m : spec.footprint_radius_m,
        .restricted = areas_of(spec.restricted)};
    agent.speed_mps = spec.speed_mps;
    agent.sight_radius_m = spec.sight_radius_m;
    agent.preferred = areas_of(spec.preferred);
    IVO_CONTRACT(problem.agents.push_back(agent));  // the reader refuses more agents
  }
  const bool paper = mission.planner.profile == SearchProfile::kPaper;
  const bool mts = mission.planner.heuristic == SearchHeuristic::kMts;
  problem.colony = {
      .profile = paper ? planner::Profile::kPaper : planner::Profile::kFast,
      .heuristic = mts ? planner::Heuristic::kMts : planner::Heuristic::kTsp,
      .generations = mission.planner.generations,
      .ants = mission.planner.ants,
      .beta = mission.planner.beta,
      .rho = mission.planner.rho.value_or(paper ? kPaperRho : kFastRho),
      .iteration_best = mission.planner.iteration_best,
      .ant = {.shortest_first = mission.planner.shortest_first, .max_unseen_mass = mission.planner.max_unseen_mass},
      .seed = mission.seed};
  return problem;
}

Result<MissionInputs> read_inputs(const std::string& mission_path) {
  Result<MissionFile> file = read_mission(mission_path);
  if (!file) {
    return file.error();
  }
  MissionInputs inputs{
      .file = std::move(file).value(), .map = {}, .robot = {}, .prior_image = {}, .gaussians = {}, .sub_priors = {}};
  const Mission& mission = inputs.file.mission;

  const Lines& lines = inputs.file.lines;
  Result<MapFile> map = read_map(mission.map_path);
  if (!map) {
    return lines.at("map", map.error().message);
  }
  inputs.map = std::move(map).value();

  Result<Robot> robot = read_robot(mission.agents.front().robot_path);
  if (!robot) {
    return lines.at("agent[0].robot", robot.error().message);
  }
  inputs.robot = std::move(robot).value();
  if (const double most = inputs.robot.limits.max_speed_mps; mission.agents.front().speed_mps > most) {
    return lines.at("agent[0].speed_mps", "is faster than the robot may drive; expected at most " + shortest(most) +
                                              ", limits.max_speed_mps of its file");
  }

  if (const auto* image = std::get_if<ImagePrior>(&mission.prior)) {
    Result<GreyImage> grey = read_grey(image->image_path);
    if (!grey) {
      return lines.at("prior.image", grey.error().message);
    }
    inputs.prior_image = std::move(grey).value();
  } else if (const auto* mixture = std::get_if<GaussianMixturePrior>(&mission.prior)) {
    for (const Gaussian& part : mixture->components) {
      inputs.gaussians.push_back({part.mean, part.sigma_m, part.weight});
    }
  }
  Result<SubPriorInputs> sub_priors = read_sub_priors(inputs.file);
  if (!sub_priors) {
    return sub_priors.error();
  }
  inputs.sub_priors = std::move(sub_priors).value();
  return inputs;
}

namespace {

bool reaches(const planner::SegmentedMap& map, const Polygon& polygon) {
  Point low = polygon.front();
  Point high = low;
  for (const Point p : polygon) {
    low = {std::min(low.x_m, p.x_m), std::min(low.y_m, p.y_m)};
    high = {std::max(high.x_m, p.x_m), std::max(high.y_m, p.y_m)};
  }
  return high.x_m > 0 && high.y_m > 0 && low.x_m < map.width_m() && low.y_m < map.height_m();
}

// What lies off the map would be taken without effect: the writer meant something else.
std::optional<Error> off_the_map(const MissionInputs& inputs) {
  const planner::SegmentedMap map = inputs.map.view();
  const Mission& mission = inputs.file.mission;
  const std::string expected = "; expected a place on the map, 0 to " + shortest(map.width_m()) + ", 0 to " +
                               shortest(map.height_m()) + " (metres)";
  if (mission.planner.cell_m > std::min(map.width_m(), map.height_m())) {
    return inputs.file.lines.at("planner.cell_m", "a cell is larger than the map; expected a part of a metre");
  }
  for (std::size_t i = 0; i < inputs.gaussians.size(); ++i) {
    if (const Point mean = inputs.gaussians[i].mean; !map.contains(mean)) {
      return inputs.file.lines.at("prior.gaussians[" + std::to_string(i) + "].mean_m",
                                  shortest(mean) + " is outside the map" + expected);
    }
  }
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    for (const auto& [key, areas] : {std::pair{"preferred", &mission.agents[m].preferred},
                                     std::pair{"restricted", &mission.agents[m].restricted}}) {
      for (std::size_t i = 0; i < areas->size(); ++i) {
        if (!reaches(map, (*areas)[i])) {
          return inputs.file.lines.at("agent[" + std::to_string(m) + "]." + key + "[" + std::to_string(i) + "]",
                                      "lies outside the map" + expected);
        }
      }
    }
  }
  if (const Point* object = std::get_if<Point>(&mission.object)) {
    if (!map.contains(*object)) {
      return inputs.file.lines.at("object", shortest(*object) + " is outside the map" + expected);
    }
    const int column = static_cast<int>(object->x_m / map.resolution_m);
    const int row = static_cast<int>(object->y_m / map.resolution_m);
    if (map.obstacle(column, row)) {
      return inputs.file.lines.at("object", shortest(*object) + " is inside an obstacle, " +
                                                std::string(name_of(map.at(column, row))) + "; expected a free place");
    }
  }
  return std::nullopt;
}

}  // namespace

Result<void> prepare(planner::Planner& planner, const MissionInputs& inputs) {
  if (const std::optional<Error> error = off_the_map(inputs)) {
    return *error;
  }
  if (const planner::Refusal refusal = planner.prepare(inputs.problem())) {
    return sentence_of(refusal, inputs);
  }
  return {};
}

}  // namespace ivo::firmware
