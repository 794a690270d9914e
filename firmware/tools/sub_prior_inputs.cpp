#include "firmware/tools/sub_prior_inputs.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace ivo::firmware {
namespace {

std::string gaussian_key(std::size_t i) { return "prior.gaussians[" + std::to_string(i) + "]"; }
std::string agent_key(std::size_t m) { return "agent[" + std::to_string(m) + "]"; }

Result<std::vector<std::int8_t>> dealt(const MissionFile& file, const std::vector<Gaussian>& components) {
  std::vector<std::int8_t> agents;
  const std::vector<AgentSpec>& team = file.mission.agents;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const std::string& name = components[i].agent;
    if (name.empty()) {
      return file.lines.at(gaussian_key(i) + ".agent", "missing; expected every Gaussian to name an agent, or none");
    }
    const auto found = std::find_if(team.begin(), team.end(), [&](const AgentSpec& spec) { return spec.name == name; });
    if (found == team.end()) {
      return file.lines.at(gaussian_key(i) + ".agent",
                           "\"" + name + "\" is no agent of this mission; expected the name of one");
    }
    agents.push_back(static_cast<std::int8_t>(found - team.begin()));
  }
  return agents;
}

Result<std::vector<GreyImage>> images_of(const MissionFile& file) {
  std::vector<GreyImage> images;
  for (std::size_t m = 0; m < file.mission.agents.size(); ++m) {
    const std::optional<ImagePrior>& sub_prior = file.mission.agents[m].sub_prior;
    if (!sub_prior) {
      return file.lines.at(agent_key(m) + ".sub_prior", "missing; expected every agent to have one, or none");
    }
    Result<GreyImage> image = read_grey(sub_prior->image_path);
    if (!image) {
      return file.lines.at(agent_key(m) + ".sub_prior.image", image.error().message);
    }
    images.push_back(std::move(image).value());
  }
  return images;
}

}  // namespace

planner::SubPriorChoice SubPriorInputs::choice() const {
  if (alike) {
    return planner::AlikeSubPriors{};
  }
  if (!agent_of_component.empty()) {
    return planner::DealtComponents{agent_of_component};
  }
  if (!views.empty()) {
    return planner::SubPriorImages{views};
  }
  return {};
}

Result<SubPriorInputs> read_sub_priors(const MissionFile& file) {
  const Mission& mission = file.mission;
  SubPriorInputs inputs;
  inputs.alike = mission.alike_sub_priors;
  bool given = inputs.alike;
  if (const auto* mixture = std::get_if<GaussianMixturePrior>(&mission.prior)) {
    const std::vector<Gaussian>& components = mixture->components;
    const auto named = std::find_if(components.begin(), components.end(),
                                    [](const Gaussian& component) { return !component.agent.empty(); });
    if (named != components.end()) {
      if (given) {
        return file.lines.at(gaussian_key(static_cast<std::size_t>(named - components.begin())) + ".agent",
                             "gives sub-priors a second time beside prior.sub_priors; expected one of the two");
      }
      Result<std::vector<std::int8_t>> agents = dealt(file, components);
      if (!agents) {
        return agents.error();
      }
      inputs.agent_of_component = std::move(agents).value();
      given = true;
    }
  }
  const auto has_image = [](const AgentSpec& spec) { return spec.sub_prior.has_value(); };
  const auto first = std::find_if(mission.agents.begin(), mission.agents.end(), has_image);
  if (first == mission.agents.end()) {
    return inputs;
  }
  if (given) {
    return file.lines.at(agent_key(static_cast<std::size_t>(first - mission.agents.begin())) + ".sub_prior",
                         "gives sub-priors a second time beside the prior's; expected one of the two");
  }
  Result<std::vector<GreyImage>> images = images_of(file);
  if (!images) {
    return images.error();
  }
  inputs.images = std::move(images).value();
  for (std::size_t m = 0; m < inputs.images.size(); ++m) {
    const GreyImage& image = inputs.images[m];
    inputs.views.push_back({image.values, image.width_px, image.height_px, mission.agents[m].sub_prior->resolution_m});
  }
  return inputs;
}

}  // namespace ivo::firmware
