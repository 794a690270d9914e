// The services of a session by name, and those that say what there is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config/base/result.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/web/ros/ros_messages.hpp"
#include "firmware/web/ros/ros_mission.hpp"
#include "firmware/web/ros/ros_request.hpp"
#include "firmware/web/ros/value_writer.hpp"

namespace ivo::firmware::web {

/// A std_srvs/Trigger.
struct RosTrigger {
  RosAsk what{};
  std::optional<std::string> token;  ///< of an agent, behind /ivo/found/
};
[[nodiscard]] std::optional<RosTrigger> trigger_named(std::string_view name);

/// Whether `name` is a service of rosapi that is answered here.
[[nodiscard]] bool is_rosapi(std::string_view name);
/// The answer's values; an error when `args` lacks what it needs.
[[nodiscard]] Result<void> write_rosapi(ValueWriter& writer, std::string_view name, const Json& args,
                                        const RosMission* mission, const RosStamp& stamp);

}  // namespace ivo::firmware::web
