#include "firmware/web/ros/ros_mission.hpp"

#include <algorithm>

#include "firmware/files/json_reading.hpp"
#include "firmware/files/json_value.hpp"

namespace ivo::firmware::web {
namespace {

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

RosAgent ros_agent(JsonReading& reading, const Json& agent, const std::string& at, const RosMission& before) {
  RosAgent read;
  read.name = reading.text(agent, at, "name");
  read.person = reading.text(agent, at, "kind") == "person";
  read.token = topic_token(read.name);
  const std::string first = read.token;
  for (int n = 2; before.agent_of(read.token); ++n) {
    read.token = first + "_" + std::to_string(n);
  }
  return read;
}

}  // namespace

std::string topic_token(std::string_view name) {
  std::string token;
  for (const char c : name) {
    if (is_letter_or_digit(c)) {
      token += c;
    } else if (!token.empty() && token.back() != '_') {
      token += '_';
    }
  }
  while (!token.empty() && token.back() == '_') {
    token.pop_back();
  }
  const bool begins_well = !token.empty() && (token.front() < '0' || token.front() > '9');
  return begins_well ? token : token.empty() ? "agent" : "agent_" + token;
}

std::optional<std::size_t> RosMission::agent_of(std::string_view token) const {
  const auto found = std::find_if(agents.begin(), agents.end(), [&](const RosAgent& a) { return a.token == token; });
  return found == agents.end() ? std::nullopt
                               : std::optional<std::size_t>(static_cast<std::size_t>(found - agents.begin()));
}

std::optional<RosMission> mission_of(const std::string& document) {
  constexpr std::uint64_t kMostSide = 1U << 16U;
  const Result<Json> json = parse_json(document, "mission", "the mission");
  if (!json) {
    return std::nullopt;
  }
  const Json& root = json.value();
  JsonReading reading("mission");
  RosMission mission;
  mission.name = reading.text(root, "", "name");
  if (const Json* const map = reading.field(root, "", "map")) {
    mission.width_px = static_cast<int>(reading.count(*map, "map.", "width_px", kMostSide));
    mission.height_px = static_cast<int>(reading.count(*map, "map.", "height_px", kMostSide));
    mission.resolution_m = reading.number(*map, "map.", "resolution_m", 1e-6, 1e6);
    if (const Json* const origin = map->member("origin_m")) {
      mission.origin_m = reading.point(*origin, "map.origin_m");
    }
  }
  if (const Json* const cells = reading.field(root, "", "cells")) {
    mission.columns = static_cast<int>(reading.count(*cells, "cells.", "columns", kMostSide));
    mission.rows = static_cast<int>(reading.count(*cells, "cells.", "rows", kMostSide));
    mission.cell_m = reading.number(*cells, "cells.", "cell_m", 1e-6, 1e6);
  }
  for (const Json& element : reading.list(root, "", "classes").elements) {
    mission.obstacle.push_back(reading.flag(element, "classes.", "obstacle"));
  }
  for (const Json& element : reading.list(root, "", "agents").elements) {
    mission.agents.push_back(ros_agent(reading, element, "agents.", mission));
  }
  return reading.ok() ? std::optional<RosMission>(std::move(mission)) : std::nullopt;
}

}  // namespace ivo::firmware::web
