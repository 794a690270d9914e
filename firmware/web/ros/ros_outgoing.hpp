// What is given out on each topic, made from what the server knows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "firmware/web/ros/ros_messages.hpp"
#include "firmware/web/ros/ros_mission.hpp"
#include "firmware/web/ros/ros_topics.hpp"
#include "firmware/web/ros/value_writer.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

/// Two that differ: the topic has something new. 0: it has nothing yet.
[[nodiscard]] std::uint64_t version_of(Outgoing what, const View& view, Instant now);
/// The least time between two messages, whatever the subscriber asks for: grids cost.
[[nodiscard]] Duration least_period_of(Outgoing what);

/// The value of a message; `agent` of those topics that have one. False, and nothing written, when there is none.
[[nodiscard]] bool write_message(ValueWriter& writer, Outgoing what, std::optional<std::size_t> agent, const View& view,
                                 const RosMission& mission, const RosStamp& stamp);

/// std_msgs/String of /ivo/state: the controller's mode, or why there is none.
[[nodiscard]] std::string_view state_text(const View& view);

}  // namespace ivo::firmware::web
