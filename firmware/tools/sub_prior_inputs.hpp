// Sub-priors that a mission gives, ready for the planner.
#pragma once

#include <cstdint>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/files/grey_image.hpp"
#include "firmware/files/mission_file.hpp"
#include "planner/prior/sub_priors.hpp"

namespace ivo::firmware {

/// At most one of the three is given.
struct SubPriorInputs {
  bool alike = false;
  std::vector<std::int8_t> agent_of_component;
  std::vector<GreyImage> images;         ///< one an agent
  std::vector<planner::GreyView> views;  ///< of the images

  /// Points into this object.
  [[nodiscard]] planner::SubPriorChoice choice() const;
};

/// Reads the images. Refuses, by line and key: two ways of giving them at once, a Gaussian without an agent or with one
/// that the mission does not have, an agent without a sub-prior where another has one.
[[nodiscard]] Result<SubPriorInputs> read_sub_priors(const MissionFile& file);

}  // namespace ivo::firmware
