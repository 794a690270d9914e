// From a mission's files to the planner's problem, and from the planner's refusal to a sentence that names the line to
// change.
#pragma once

#include <optional>
#include <vector>

#include "config/base/result.hpp"
#include "config/robot.hpp"
#include "firmware/files/grey_image.hpp"
#include "firmware/files/map_file.hpp"
#include "firmware/files/mission_file.hpp"
#include "firmware/tools/sub_prior_inputs.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware {

/// Everything a run reads before it starts. Views in `problem()` point into it.
struct MissionInputs {
  MissionFile file;
  MapFile map;
  Robot robot;
  std::optional<GreyImage> prior_image;
  std::vector<planner::GaussianComponent> gaussians;
  SubPriorInputs sub_priors;

  [[nodiscard]] planner::SearchProblem problem() const;
};

/// Reads a mission and every file it names.
[[nodiscard]] Result<MissionInputs> read_inputs(const std::string& mission_path);

/// What the planner refuses, as FILE:LINE: KEY: what was wrong; what is expected.
[[nodiscard]] Error sentence_of(const planner::Refusal& refusal, const MissionInputs& inputs);

/// Prepares `planner` for the mission; what it refuses comes back as FILE:LINE: KEY: what was wrong; what is expected.
[[nodiscard]] Result<void> prepare(planner::Planner& planner, const MissionInputs& inputs);

}  // namespace ivo::firmware
