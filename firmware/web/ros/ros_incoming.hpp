// What a published message asks for or shows.
#pragma once

#include <cstdint>
#include <optional>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/web/layer.hpp"
#include "firmware/web/request.hpp"
#include "firmware/web/ros/ros_mission.hpp"
#include "firmware/web/ros/ros_topics.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

struct RosHeard {
  std::optional<Request> request;
  std::optional<Layer> layer;
};

/// What is known beside the message.
struct RosSetting {
  const View& view;
  const RosMission& mission;
  std::uint32_t claimed_slots = 0;  ///< a bit a slot: areas that were put and are not among the view's yet
  std::uint32_t accepted_plan = 0;  ///< as of ros_request()
  Instant now{};
  Duration since_epoch{};
};

/// Strict: what is wrong with the message is said in an error, "FIELD: what was wrong; what is expected".
[[nodiscard]] Result<RosHeard> heard_of(const Topic<Incoming>& topic, const Json& message, const RosSetting& setting);

}  // namespace ivo::firmware::web
