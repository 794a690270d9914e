#include "firmware/web/ros/ros_documents.hpp"

#include "firmware/console/console_messages.hpp"
#include "firmware/files/json_reading.hpp"
#include "firmware/files/json_value.hpp"

namespace ivo::firmware::web {
namespace {

std::vector<Point> points_of(JsonReading& reading, const Json& object, const char* key) {
  std::vector<Point> points;
  const Json* const list = reading.field(object, "", key);
  if (list != nullptr) {
    for (const Json& point : list->elements) {
      points.push_back(reading.point(point, key));
    }
  }
  return points;
}

/// The objects of the list `key`; empty when it is no such document.
std::vector<Json> elements_of(const std::string& text, const char* key) {
  const Result<Json> json = parse_json(text, key, "a document");
  const Json* const list = json ? json.value().member(key) : nullptr;
  return list == nullptr ? std::vector<Json>{} : list->elements;
}

}  // namespace

std::vector<std::vector<Point>> waypoints_of(const std::string& plan) {
  std::vector<std::vector<Point>> waypoints;
  JsonReading reading("plan");
  for (const Json& agent : elements_of(plan, "agents")) {
    waypoints.push_back(points_of(reading, agent, "waypoints_m"));
  }
  return reading.ok() ? waypoints : std::vector<std::vector<Point>>{};
}

std::vector<RosArea> areas_of(const std::string& areas) {
  std::vector<RosArea> read;
  JsonReading reading("areas");
  for (const Json& element : elements_of(areas, "areas")) {
    RosArea area;
    area.slot = static_cast<std::uint8_t>(reading.count(element, "", "slot", console::kAreaSlots - 1));
    area.no_go = reading.text(element, "", "purpose") == "no_go";
    const Json* const agent = reading.field(element, "", "agent");
    if (agent != nullptr && agent->kind != Json::Kind::kNull) {
      area.agent = reading.count(element, "", "agent", console::kAgents - 1);
    }
    area.polygon = points_of(reading, element, "polygon_m");
    read.push_back(std::move(area));
  }
  return reading.ok() ? read : std::vector<RosArea>{};
}

}  // namespace ivo::firmware::web
