#include "firmware/web/mission_facts.hpp"

#include <cstdint>

#include "firmware/files/json_reading.hpp"
#include "firmware/files/json_value.hpp"

namespace ivo::firmware::web {

std::optional<MissionFacts> mission_facts(const std::string& document) {
  constexpr std::uint64_t kMostPixels = 100'000;  // of a side
  const Result<Json> json = parse_json(document, "mission", "a mission");
  if (!json) {
    return std::nullopt;
  }
  JsonReading reading("mission");
  const Json* const map = reading.field(json.value(), "", "map");
  if (map == nullptr) {
    return std::nullopt;
  }
  MissionFacts facts;
  facts.width_px = static_cast<int>(reading.count(*map, "map.", "width_px", kMostPixels));
  facts.height_px = static_cast<int>(reading.count(*map, "map.", "height_px", kMostPixels));
  facts.resolution_m = reading.number(*map, "map.", "resolution_m", 1e-6, 1e6);
  if (const Json* const origin = map->member("origin_m")) {
    facts.origin_m = reading.point(*origin, "map.origin_m");
  }
  for (const Json& one : reading.list(json.value(), "", "classes").elements) {
    facts.obstacle.push_back(reading.flag(one, "classes.", "obstacle"));
  }
  for (const Json& one : reading.list(json.value(), "", "agents").elements) {
    facts.agents.push_back(reading.text(one, "agents.", "name"));
  }
  return reading.ok() ? std::optional(facts) : std::nullopt;
}

}  // namespace ivo::firmware::web
