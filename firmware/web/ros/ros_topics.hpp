// The topics of a session by name: what is given out and what is taken in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/web/ros/ros_mission.hpp"

namespace ivo::firmware::web {

enum class Outgoing : std::uint8_t {
  kMap,
  kProbability,
  kProbabilityMass,
  kBelief,
  kBeliefMass,
  kNoGo,
  kAreas,
  kState,
  kDiagnostics,
  kTransform,
  kPlan,  ///< with an agent, and of the robot without one
  kPose,  ///< with an agent
};

enum class Incoming : std::uint8_t {
  kRobotPose,
  kScan,
  kPoints,
  kPeople,
  kRemoveArea,
  kInit,
  kReplan,
  kStart,
  kFound,          ///< with an agent, and of the first person without one
  kNoGoArea,       ///< with an agent, and of everybody without one
  kPreferredArea,  ///< with an agent
  kPersonPose,     ///< with an agent
};

template <class What>
struct Topic {
  What what{};
  std::string_view type;             ///< "nav_msgs/Path"
  std::optional<std::string> token;  ///< of the agent that the name ends in
};

/// None when no topic has that name; whether there is such an agent is not looked at. A leading slash may be missing.
[[nodiscard]] std::optional<Topic<Outgoing>> outgoing_topic(std::string_view name);
[[nodiscard]] std::optional<Topic<Incoming>> incoming_topic(std::string_view name);

struct NamedTopic {
  std::string name;
  std::string_view type;
};
/// Those with an agent once for each of the mission.
[[nodiscard]] std::vector<NamedTopic> all_topics(const RosMission* mission);

/// "nav_msgs/msg/Path" as "nav_msgs/Path".
[[nodiscard]] std::string short_type(std::string_view type);
/// "nav_msgs/msg/Path": a client of ROS 2.
[[nodiscard]] inline bool is_ros2_type(std::string_view type) {
  return type.find("/msg/") != std::string_view::npos || type.find("/srv/") != std::string_view::npos;
}
/// Buttons are std_msgs/Empty, and std_msgs/Bool too.
[[nodiscard]] bool is_button(Incoming what);

}  // namespace ivo::firmware::web
