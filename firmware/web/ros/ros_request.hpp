// What a ROS client may ask for by a service or a button, put as a screen's request about what is shown now.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/base/result.hpp"
#include "firmware/web/request.hpp"
#include "firmware/web/ros/ros_mission.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

enum class RosAsk : std::uint8_t {
  kInit,
  kReplan,
  kEnough,
  kAccept,
  kStart,  ///< a plan that was accepted
  kFound,  ///< with an agent; without one by the first person, or by the robot where there is none
  kStop,
  kEnd,
  kClearFault,
  kTakeControl,
  kReleaseControl,
  kGiveControl,
  kKeepControl,
};

/// An error says why that cannot be asked now. `accepted_plan`: the number of a plan that was accepted, as the
/// controller has answered, though its status may not say so yet; 0: none.
[[nodiscard]] Result<Request> ros_request(RosAsk what, std::optional<std::size_t> agent, const View& view,
                                          const RosMission& mission, std::uint32_t accepted_plan);

}  // namespace ivo::firmware::web
