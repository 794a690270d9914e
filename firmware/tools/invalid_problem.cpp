#include "firmware/tools/invalid_problem.hpp"

#include <array>
#include <cstddef>
#include <string>

#include "firmware/files/number_text.hpp"

namespace ivo::firmware {
namespace {

Error out_of_range(const planner::Refusal& refusal, const Lines& lines) {
  struct Parameter {
    const char* key;
    const char* expected;
  };
  constexpr std::array<Parameter, 7> kParameters = {{{"generations", "at least 1"},
                                                     {"ants", "at least 1"},
                                                     {"beta", "0 to 12"},
                                                     {"rho", "above 0, at most 1"},
                                                     {"iteration_best", "0 to 1"},
                                                     {"shortest_first", "0 to 1"},
                                                     {"max_unseen_mass", "0 to 1"}}};  // as ColonyParameterNumber
  const Parameter& parameter = kParameters.at(static_cast<std::size_t>(refusal.area));
  return lines.at(std::string("planner.") + parameter.key,
                  shortest(refusal.value) + " is out of range; expected " + parameter.expected);
}

}  // namespace

Error invalid_problem(const planner::Refusal& refusal, const Lines& lines) {
  using planner::RefusalCode;
  const std::string agent_key = "agent[" + std::to_string(refusal.agent) + "]";
  const std::string component_key = "prior.gaussians[" + std::to_string(refusal.area) + "]";
  const std::string value = shortest(refusal.value);
  switch (refusal.code) {
    case RefusalCode::kMapInvalid:
      return lines.at("map", refusal.limit > 0
                                 ? "has " + value + " pixels; expected " + shortest(refusal.limit)
                                 : "is empty or has " + value + " metres a pixel; expected pixels of a size above 0");
    case RefusalCode::kNoAgents:
      return lines.at("agent", "there is no agent; expected at least one");
    case RefusalCode::kCellSizeInvalid:
      return lines.at("planner.cell_m", value + " is no size of a cell; expected metres above 0");
    case RefusalCode::kSpacingInvalid:
      return lines.at("planner.spacing_m",
                      value + " is no side of a square; expected metres above 0, at most " + shortest(refusal.limit));
    case RefusalCode::kClearanceInvalid:
      return lines.at("planner.clearance_m", value + " is no distance; expected metres, 0 or more");
    case RefusalCode::kSpeedInvalid:
      return lines.at(agent_key + ".speed_mps", value + " is no speed to search at; expected at least " +
                                                    shortest(refusal.limit) + " (metres a second)");
    case RefusalCode::kSightInvalid:
      return lines.at(agent_key + ".sight_radius_m", value + " is no radius to see with; expected above 0, at most " +
                                                         shortest(refusal.limit) + " (metres)");
    case RefusalCode::kFootprintInvalid:
      return lines.at(agent_key + ".footprint_radius_m", value + " is no radius; expected metres, 0 or more");
    case RefusalCode::kAreaInvalid:
      return lines.at(
          agent_key + (refusal.value > 0 ? ".restricted[" : ".preferred[") + std::to_string(refusal.area) + "]",
          "is no polygon; expected at least 3 vertices, in metres");
    case RefusalCode::kGaussianInvalid:
      return lines.at(component_key, "is no Gaussian; expected a finite mean, sigma_m above 0 and a weight, 0 or more");
    case RefusalCode::kImageInvalid:
      return lines.at(refusal.agent >= 0 ? agent_key + ".sub_prior" : "prior.image",
                      "is no image: " + value + " pixels of " + shortest(refusal.limit) +
                          "; expected a whole one and metres a pixel above 0");
    case RefusalCode::kColonyInvalid:
      return out_of_range(refusal, lines);
    case RefusalCode::kSubPriorsMismatch:
      return lines.at("prior", "sub-priors for " + value + "; expected for " + shortest(refusal.limit));
    case RefusalCode::kComponentDealtToNobody:
      return lines.at(component_key + ".agent", "agent " + value + " of " + shortest(refusal.limit) +
                                                    " is none; expected an agent of this mission");
    default:
      return {"the planner refused the mission"};
  }
}

}  // namespace ivo::firmware
