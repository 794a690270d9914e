#include "firmware/web/ros/ros_topics.hpp"

#include <array>

namespace ivo::firmware::web {
namespace {

enum class Agents : std::uint8_t { kNone, kOptional, kRequired };

/// `before` and `after`: the name up to and behind the agent's token.
template <class What>
struct TopicRow {
  What what{};
  std::string_view before;
  std::string_view after;
  Agents agents{};
  std::string_view type;
};

constexpr std::array<TopicRow<Outgoing>, 12> kOutgoing = {{
    {Outgoing::kMap, "/ivo/map", "", Agents::kNone, "nav_msgs/OccupancyGrid"},
    {Outgoing::kProbability, "/ivo/probability", "", Agents::kNone, "nav_msgs/OccupancyGrid"},
    {Outgoing::kProbabilityMass, "/ivo/probability/mass", "", Agents::kNone, "std_msgs/Float32MultiArray"},
    {Outgoing::kBelief, "/ivo/belief", "", Agents::kNone, "nav_msgs/OccupancyGrid"},
    {Outgoing::kBeliefMass, "/ivo/belief/mass", "", Agents::kNone, "std_msgs/Float32MultiArray"},
    {Outgoing::kNoGo, "/ivo/no_go", "", Agents::kNone, "nav_msgs/OccupancyGrid"},
    {Outgoing::kAreas, "/ivo/areas", "", Agents::kNone, "visualization_msgs/MarkerArray"},
    {Outgoing::kState, "/ivo/state", "", Agents::kNone, "std_msgs/String"},
    {Outgoing::kDiagnostics, "/diagnostics", "", Agents::kNone, "diagnostic_msgs/DiagnosticArray"},
    {Outgoing::kTransform, "/tf", "", Agents::kNone, "tf2_msgs/TFMessage"},
    {Outgoing::kPlan, "/ivo/plan", "", Agents::kOptional, "nav_msgs/Path"},
    {Outgoing::kPose, "/ivo/pose", "", Agents::kRequired, "geometry_msgs/PoseStamped"},
}};

constexpr std::array<TopicRow<Incoming>, 12> kIncoming = {{
    {Incoming::kRobotPose, "/ivo/robot/pose", "", Agents::kNone, "geometry_msgs/PoseWithCovarianceStamped"},
    {Incoming::kScan, "/scan", "", Agents::kNone, "sensor_msgs/LaserScan"},
    {Incoming::kPoints, "/points", "", Agents::kNone, "sensor_msgs/PointCloud2"},
    {Incoming::kPeople, "/people", "", Agents::kNone, "geometry_msgs/PoseArray"},
    {Incoming::kRemoveArea, "/ivo/remove_area", "", Agents::kNone, "std_msgs/UInt8"},
    {Incoming::kInit, "/ivo/button/init", "", Agents::kNone, "std_msgs/Empty"},
    {Incoming::kReplan, "/ivo/button/replan", "", Agents::kNone, "std_msgs/Empty"},
    {Incoming::kStart, "/ivo/button/start", "", Agents::kNone, "std_msgs/Empty"},
    {Incoming::kFound, "/ivo/button/object_found", "", Agents::kOptional, "std_msgs/Empty"},
    {Incoming::kNoGoArea, "/ivo/no_go_area", "", Agents::kOptional, "geometry_msgs/PolygonStamped"},
    {Incoming::kPreferredArea, "/ivo/preferred_area", "", Agents::kRequired, "geometry_msgs/PolygonStamped"},
    {Incoming::kPersonPose, "/ivo/person", "/pose", Agents::kRequired, "geometry_msgs/PoseStamped"},
}};

template <class Rows>
auto topic_in(const Rows& rows, std::string_view name) {
  using What = decltype(rows.front().what);
  std::string with_slash;
  if (!name.starts_with('/')) {
    with_slash = "/" + std::string(name);
    name = with_slash;
  }
  std::optional<Topic<std::remove_const_t<What>>> found;
  for (const auto& row : rows) {
    if (name == row.before && row.agents != Agents::kRequired) {
      found = {row.what, row.type, std::nullopt};
    } else if (row.agents != Agents::kNone && name.starts_with(row.before) && name.ends_with(row.after) &&
               name.size() > row.before.size() + 1 + row.after.size() && name[row.before.size()] == '/') {
      const std::string_view token =
          name.substr(row.before.size() + 1, name.size() - row.before.size() - 1 - row.after.size());
      if (token.find('/') == std::string_view::npos) {
        found = {row.what, row.type, std::string(token)};
      }
    }
  }
  return found;
}

template <class Rows>
void add_topics(std::vector<NamedTopic>& topics, const Rows& rows, const RosMission* mission) {
  for (const auto& row : rows) {
    if (row.agents != Agents::kRequired) {
      topics.push_back({std::string(row.before), row.type});
    }
    if (row.agents != Agents::kNone && mission != nullptr) {
      for (const RosAgent& agent : mission->agents) {
        topics.push_back({std::string(row.before).append("/").append(agent.token).append(row.after), row.type});
      }
    }
  }
}

}  // namespace

std::optional<Topic<Outgoing>> outgoing_topic(std::string_view name) { return topic_in(kOutgoing, name); }
std::optional<Topic<Incoming>> incoming_topic(std::string_view name) { return topic_in(kIncoming, name); }

std::vector<NamedTopic> all_topics(const RosMission* mission) {
  std::vector<NamedTopic> topics;
  add_topics(topics, kOutgoing, mission);
  add_topics(topics, kIncoming, mission);
  return topics;
}

std::string short_type(std::string_view type) {
  std::string text(type);
  for (const std::string_view part : {"/msg/", "/srv/"}) {
    if (const std::size_t at = text.find(part); at != std::string::npos) {
      return text.replace(at, part.size(), "/");
    }
  }
  return text;
}

bool is_button(Incoming what) {
  return what == Incoming::kInit || what == Incoming::kReplan || what == Incoming::kStart || what == Incoming::kFound;
}

}  // namespace ivo::firmware::web
