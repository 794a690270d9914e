#include "firmware/web/ros/ros_incoming.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "firmware/web/ros/message_reading.hpp"
#include "firmware/web/ros/ros_documents.hpp"
#include "firmware/web/ros/ros_request.hpp"

namespace ivo::firmware::web {
namespace {

std::optional<std::uint8_t> free_slot(const RosSetting& setting) {
  std::uint32_t taken = setting.claimed_slots;
  const KnownDocument& document = setting.view.document(console::Document::kAreas);
  for (const RosArea& area : document.there() ? areas_of(*document.bytes) : std::vector<RosArea>{}) {
    taken |= 1U << area.slot;
  }
  for (std::uint8_t slot = 0; slot < console::kAreaSlots; ++slot) {
    if ((taken >> slot & 1U) == 0) {
      return slot;
    }
  }
  return std::nullopt;
}

Request put_area(JsonReading& reading, bool no_go, std::optional<std::size_t> agent, const Json& message,
                 const RosSetting& setting) {
  PutArea put;
  expect_map_frame(reading, message);
  for (const Point corner : polygon_of(reading, message)) {
    put.polygon.push_back(setting.mission.from_ros(corner));
  }
  const std::optional<std::uint8_t> slot = free_slot(setting);
  if (!slot) {
    reading.fault("", "no slot is free; expected fewer than 32 areas, /ivo/remove_area makes room");
  }
  put.slot = slot.value_or(0);
  put.purpose = no_go ? console::AreaPurpose::kNoGo : console::AreaPurpose::kPreferred;
  put.agent = agent ? static_cast<std::uint8_t>(*agent) : console::AreaCommand::kEverybody;
  return put;
}

Request position_of(const UncertainPose& uncertain, std::size_t agent, double age, const RosMission& mission) {
  const Point place = mission.from_ros(uncertain.pose.point());
  return Position{static_cast<std::uint8_t>(agent),
                  {place.x_m, place.y_m, uncertain.pose.heading_rad},
                  uncertain.sigma_m,
                  uncertain.sigma_heading_rad,
                  age};
}

/// As many as a layer holds, evenly chosen, in our frame.
std::vector<Point> layer_points(const std::vector<Point>& points, PointFrame frame, const RosSetting& setting) {
  const std::size_t step = points.size() / (Layer::kMostPoints + 1) + 1;
  std::vector<Point> placed;
  placed.reserve(points.size() / step + 1);
  const console::Status status = setting.view.status.value_or(console::Status{});
  const double c = std::cos(status.heading_rad);
  const double s = std::sin(status.heading_rad);
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Point p = points[i];
    placed.push_back(frame == PointFrame::kMap ? setting.mission.from_ros(p)
                                               : Point{status.agent[0].x_m + c * p.x_m - s * p.y_m,
                                                       status.agent[0].y_m + s * p.x_m + c * p.y_m});
  }
  return placed;
}

Layer layer_of(JsonReading& reading, LayerName name, PointFrame frame, const std::vector<Point>& points,
               const RosSetting& setting) {
  if (frame == PointFrame::kRobot && !setting.view.status) {
    reading.fault("", "is seen from a robot whose place nobody knows yet; expected a controller that is there");
  }
  return {name, setting.now, layer_points(points, frame, setting), 0.0};
}

/// std_msgs/Bool or std_msgs/Empty: a false is a button that was let go.
bool pressed(JsonReading& reading, const Json& message) {
  return message.member("data") == nullptr || reading.flag(message, "", "data");
}

RosHeard robot_pose(JsonReading& reading, const Json& message, const RosSetting& setting) {
  expect_map_frame(reading, message);
  const double age = age_s(reading, message, setting.since_epoch);
  const Json* const pose = reading.field(message, "", "pose");
  if (pose == nullptr) {
    return {};
  }
  const UncertainPose uncertain = uncertain_pose_of(reading, *pose);
  const Point place = setting.mission.from_ros(uncertain.pose.point());
  return {position_of(uncertain, 0, age, setting.mission),
          Layer{LayerName::kRobotPose, setting.now - from_seconds(age), {place}, uncertain.pose.heading_rad}};
}

RosHeard person_pose(JsonReading& reading, std::size_t agent, const Json& message, const RosSetting& setting) {
  if (!setting.mission.agents[agent].person) {
    reading.fault("", "is about a robot; expected a person, of the robot comes /ivo/robot/pose");
  }
  expect_map_frame(reading, message);
  const double age = age_s(reading, message, setting.since_epoch);
  const Json* const pose = reading.field(message, "", "pose");
  if (pose == nullptr) {
    return {};
  }
  return {position_of({pose_of(reading, *pose, "pose.", false), 0.0, 0.0}, agent, age, setting.mission), std::nullopt};
}

RosHeard button(JsonReading& reading, RosAsk what, std::optional<std::size_t> agent, const Json& message,
                const RosSetting& setting) {
  if (!pressed(reading, message) || !reading.ok()) {
    return {};
  }
  const Result<Request> request = ros_request(what, agent, setting.view, setting.mission, setting.accepted_plan);
  if (!request) {
    reading.fault("", request.error().message);
    return {};
  }
  return {request.value(), std::nullopt};
}

RosHeard read_message(JsonReading& reading, Incoming what, std::optional<std::size_t> agent, const Json& message,
                      const RosSetting& setting) {
  const auto layer = [&](LayerName name, PointFrame frame, const std::vector<Point>& points) {
    return RosHeard{std::nullopt, layer_of(reading, name, frame, points, setting)};
  };
  switch (what) {
    case Incoming::kRobotPose:
      return robot_pose(reading, message, setting);
    case Incoming::kPersonPose:
      return person_pose(reading, agent.value_or(0), message, setting);
    case Incoming::kScan: {
      const PointFrame frame = point_frame(reading, message, false);
      return layer(LayerName::kScan, frame, scan_points(reading, message));
    }
    case Incoming::kPoints: {
      const PointFrame frame = point_frame(reading, message, true);
      return layer(LayerName::kScan, frame, cloud_points(reading, message));
    }
    case Incoming::kPeople:
      expect_map_frame(reading, message);
      return layer(LayerName::kPeople, PointFrame::kMap, people_points(reading, message));
    case Incoming::kNoGoArea:
    case Incoming::kPreferredArea:
      return {put_area(reading, what == Incoming::kNoGoArea, agent, message, setting), std::nullopt};
    case Incoming::kRemoveArea:
      return {RemoveArea{static_cast<std::uint8_t>(reading.count(message, "", "data", console::kAreaSlots - 1))},
              std::nullopt};
    case Incoming::kInit:
      return button(reading, RosAsk::kInit, agent, message, setting);
    case Incoming::kReplan:
      return button(reading, RosAsk::kReplan, agent, message, setting);
    case Incoming::kStart:
      return button(reading, RosAsk::kStart, agent, message, setting);
    case Incoming::kFound:
      return button(reading, RosAsk::kFound, agent, message, setting);
  }
  return {};
}

}  // namespace

Result<RosHeard> heard_of(const Topic<Incoming>& topic, const Json& message, const RosSetting& setting) {
  if (message.kind != Json::Kind::kObject) {
    return Error{"msg: is no object; expected a " + std::string(topic.type)};
  }
  std::optional<std::size_t> agent;
  if (topic.token) {
    agent = setting.mission.agent_of(*topic.token);
    if (!agent) {
      return Error{"names an agent that is not there; expected one of /rosapi/topics"};
    }
  }
  JsonReading reading("msg");
  RosHeard heard = read_message(reading, topic.what, agent, message, setting);
  if (!reading.ok()) {
    return reading.error();
  }
  return heard;
}

}  // namespace ivo::firmware::web
