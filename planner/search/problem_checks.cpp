#include "planner/search/problem_checks.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "planner/search/planner.hpp"

namespace ivo::planner {
namespace {

bool above_zero(double value) noexcept { return std::isfinite(value) && value > 0.0; }
bool between(double value, double least, double most) noexcept { return value >= least && value <= most; }
bool finite(Point p) noexcept { return std::isfinite(p.x_m) && std::isfinite(p.y_m); }

double pixels(int width_px, int height_px) noexcept {
  return width_px > 0 && height_px > 0 ? static_cast<double>(width_px) * height_px : 0.0;
}

Refusal check_sizes(const SearchProblem& problem) noexcept {
  const SegmentedMap& map = problem.map;
  const double expected = pixels(map.width_px, map.height_px);
  if (expected == 0.0 || static_cast<double>(map.pixels.size()) != expected) {
    return {.code = RefusalCode::kMapInvalid, .value = static_cast<double>(map.pixels.size()), .limit = expected};
  }
  if (!above_zero(map.resolution_m)) {
    return {.code = RefusalCode::kMapInvalid, .value = map.resolution_m};
  }
  if (!above_zero(problem.cell_m)) {
    return {.code = RefusalCode::kCellSizeInvalid, .value = problem.cell_m};
  }
  if (!above_zero(problem.graph.spacing_m) || problem.graph.spacing_m > kMostSpacing_m) {
    return {.code = RefusalCode::kSpacingInvalid, .value = problem.graph.spacing_m, .limit = kMostSpacing_m};
  }
  if (!std::isfinite(problem.graph.clearance_m) || problem.graph.clearance_m < 0.0) {
    return {.code = RefusalCode::kClearanceInvalid, .value = problem.graph.clearance_m};
  }
  return {};
}

Refusal check_colony(const ColonyParameters& colony) noexcept {
  using enum ColonyParameterNumber;
  struct Judged {
    ColonyParameterNumber number;
    double value;
    bool sound;
  };
  const std::array<Judged, 7> parameters = {
      {{kGenerations, static_cast<double>(colony.generations), colony.generations >= 1},
       {kAnts, static_cast<double>(colony.ants), colony.ants >= 1},
       {kBeta, static_cast<double>(colony.beta), colony.beta >= 0 && colony.beta <= 12},
       {kRho, colony.rho, above_zero(colony.rho) && colony.rho <= 1.0},
       {kIterationBest, colony.iteration_best, between(colony.iteration_best, 0.0, 1.0)},
       {kShortestFirst, colony.ant.shortest_first, between(colony.ant.shortest_first, 0.0, 1.0)},
       {kMaxUnseenMass, colony.ant.max_unseen_mass, between(colony.ant.max_unseen_mass, 0.0, 1.0)}}};
  for (const Judged& parameter : parameters) {
    if (!parameter.sound) {
      return {
          .code = RefusalCode::kColonyInvalid, .area = static_cast<int>(parameter.number), .value = parameter.value};
    }
  }
  return {};
}

Refusal check_areas(const Areas& areas, int agent, bool restricted) noexcept {
  for (std::size_t i = 0; i < areas.size(); ++i) {
    bool sound = areas[i].size() >= 3;
    for (const Point vertex : areas[i]) {
      sound = sound && finite(vertex);
    }
    if (!sound) {
      return {.code = RefusalCode::kAreaInvalid,
              .agent = agent,
              .area = static_cast<int>(i),
              .value = restricted ? 1.0 : 0.0};
    }
  }
  return {};
}

Refusal check_agent(const SearchAgent& agent, int number, double cell_m) noexcept {
  if (!std::isfinite(agent.speed_mps) || agent.speed_mps < kLeastSpeed_mps) {
    return {.code = RefusalCode::kSpeedInvalid, .agent = number, .value = agent.speed_mps, .limit = kLeastSpeed_mps};
  }
  const double most_sight_m = kMostSightCells * cell_m;
  if (!above_zero(agent.sight_radius_m) || agent.sight_radius_m > most_sight_m) {
    return {.code = RefusalCode::kSightInvalid, .agent = number, .value = agent.sight_radius_m, .limit = most_sight_m};
  }
  if (!std::isfinite(agent.body.footprint_radius_m) || agent.body.footprint_radius_m < 0.0) {
    return {.code = RefusalCode::kFootprintInvalid, .agent = number, .value = agent.body.footprint_radius_m};
  }
  if (const Refusal refusal = check_areas(agent.preferred, number, false)) {
    return refusal;
  }
  return check_areas(agent.body.restricted, number, true);
}

Refusal check_image(const GreyView& image, int agent) noexcept {
  const double expected = pixels(image.width_px, image.height_px);
  if (expected == 0.0 || static_cast<double>(image.values.size()) != expected || !above_zero(image.resolution_m)) {
    return {.code = RefusalCode::kImageInvalid,
            .agent = agent,
            .value = static_cast<double>(image.values.size()),
            .limit = expected};
  }
  return {};
}

Refusal check_prior(const PriorChoice& prior) noexcept {
  if (const auto* components = std::get_if<std::span<const GaussianComponent>>(&prior)) {
    for (std::size_t i = 0; i < components->size(); ++i) {
      const GaussianComponent& g = (*components)[i];
      if (!finite(g.mean) || !std::isfinite(g.sigma_m) || g.sigma_m < kLeastSigma_m || !std::isfinite(g.weight) ||
          g.weight < 0.0) {
        return {.code = RefusalCode::kGaussianInvalid, .area = static_cast<int>(i)};
      }
    }
  } else if (const auto* image = std::get_if<GreyView>(&prior)) {
    return check_image(*image, -1);
  }
  return {};
}

Refusal check_dealing(const DealtComponents& dealt, const PriorChoice& prior, int agents) noexcept {
  const auto* components = std::get_if<std::span<const GaussianComponent>>(&prior);
  const std::size_t expected = components != nullptr ? components->size() : 0;
  const std::span<const std::int8_t> to = dealt.agent_of_component;
  if (expected == 0 || to.size() != expected) {
    return {.code = RefusalCode::kSubPriorsMismatch,
            .value = static_cast<double>(to.size()),
            .limit = static_cast<double>(expected)};
  }
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (to[i] < 0 || to[i] >= agents) {
      return {.code = RefusalCode::kComponentDealtToNobody,
              .area = static_cast<int>(i),
              .value = static_cast<double>(to[i]),
              .limit = static_cast<double>(agents)};
    }
  }
  return {};
}

Refusal check_sub_priors(const SearchProblem& problem) noexcept {
  if (std::holds_alternative<std::monostate>(problem.sub_priors)) {
    return {};
  }
  for (std::size_t m = 0; m < problem.agents.size(); ++m) {
    if (!problem.agents[m].preferred.empty()) {
      return {.code = RefusalCode::kSubPriorsTwice, .agent = static_cast<int>(m)};
    }
  }
  if (const auto* dealt = std::get_if<DealtComponents>(&problem.sub_priors)) {
    return check_dealing(*dealt, problem.prior, static_cast<int>(problem.agents.size()));
  }
  if (const auto* images = std::get_if<SubPriorImages>(&problem.sub_priors)) {
    if (images->of_agent.size() != problem.agents.size()) {
      return {.code = RefusalCode::kSubPriorsMismatch,
              .value = static_cast<double>(images->of_agent.size()),
              .limit = static_cast<double>(problem.agents.size())};
    }
    for (std::size_t m = 0; m < images->of_agent.size(); ++m) {
      if (const Refusal refusal = check_image(images->of_agent[m], static_cast<int>(m))) {
        return refusal;
      }
    }
  }
  return {};
}

}  // namespace

Refusal check(const SearchProblem& problem) noexcept {
  if (const Refusal refusal = check_sizes(problem)) {
    return refusal;
  }
  if (const Refusal refusal = check_colony(problem.colony)) {
    return refusal;
  }
  if (problem.agents.empty()) {
    return {.code = RefusalCode::kNoAgents};
  }
  for (std::size_t m = 0; m < problem.agents.size(); ++m) {
    if (const Refusal refusal = check_agent(problem.agents[m], static_cast<int>(m), problem.cell_m)) {
      return refusal;
    }
  }
  if (const Refusal refusal = check_prior(problem.prior)) {
    return refusal;
  }
  return check_sub_priors(problem);
}

}  // namespace ivo::planner
