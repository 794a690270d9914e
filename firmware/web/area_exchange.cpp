#include "firmware/web/area_exchange.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "config/limits.hpp"
#include "firmware/console/area_board.hpp"
#include "firmware/files/geojson_file.hpp"
#include "firmware/files/json_reading.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/web/controller_message.hpp"
#include "firmware/web/mission_facts.hpp"

namespace ivo::firmware::web {
namespace {

using console::Document;
using Slots = std::array<bool, console::kAreaSlots>;

std::optional<MissionFacts> facts_of(const View& view) {
  const KnownDocument& mission = view.document(Document::kMission);
  return mission.there() ? mission_facts(*mission.bytes) : std::nullopt;
}

std::optional<DrawnArea> drawn_area(const Json& json, const std::vector<std::string>& agents, JsonReading& reading) {
  static constexpr std::array<const char*, 2> kPurposes{"preferred", "no_go"};
  DrawnArea area;
  area.slot = static_cast<int>(reading.count(json, "areas.", "slot", console::kAreaSlots - 1));
  area.purpose = static_cast<DrawnPurpose>(reading.choice(json, "areas.", "purpose", kPurposes));
  const Json* const agent = reading.field(json, "areas.", "agent");
  if (agent != nullptr && agent->kind == Json::Kind::kCount && agent->count < agents.size()) {
    area.agent = agents[agent->count];
  }
  for (const Json& corner : reading.list(json, "areas.", "polygon_m").elements) {
    area.polygon.push_back(reading.point(corner, "areas.polygon_m"));
  }
  return reading.ok() ? std::optional(area) : std::nullopt;
}

/// None when there is no such document, or no mission to name the agents.
std::optional<std::vector<DrawnArea>> areas_of_controller(const View& view) {
  const KnownDocument& document = view.document(Document::kAreas);
  const std::optional<MissionFacts> facts = facts_of(view);
  if (!document.there() || !facts) {
    return std::nullopt;
  }
  const Result<Json> json = parse_json(*document.bytes, "areas", "areas");
  const Json* const list = json ? json.value().member("areas") : nullptr;
  if (list == nullptr) {
    return std::nullopt;
  }
  std::vector<DrawnArea> areas;
  JsonReading reading("areas");
  for (const Json& element : list->elements) {
    std::optional<DrawnArea> area = drawn_area(element, facts->agents, reading);
    if (!area) {
      return std::nullopt;
    }
    areas.push_back(std::move(*area));
  }
  return areas;
}

PutArea request_of_area(const DrawnArea& area, std::uint8_t slot, const std::vector<std::string>& agents) {
  const auto agent = area.agent ? std::find(agents.begin(), agents.end(), *area.agent) : agents.end();
  PutArea put;
  put.slot = slot;
  put.purpose = area.purpose == DrawnPurpose::kNoGo ? console::AreaPurpose::kNoGo : console::AreaPurpose::kPreferred;
  put.agent =
      agent == agents.end() ? console::AreaCommand::kEverybody : static_cast<std::uint8_t>(agent - agents.begin());
  put.polygon.assign(area.polygon.begin(), area.polygon.end());
  return put;
}

/// As the controller will judge each, so that a file counts whole or not at all.
Result<void> judge_areas(const std::vector<Request>& puts, const MissionFacts& facts) {
  console::AreaBoard board({.agents = static_cast<int>(facts.agents.size()),
                            .width_m = facts.width_px * facts.resolution_m,
                            .height_m = facts.height_px * facts.resolution_m});
  for (std::size_t i = 0; i < puts.size(); ++i) {
    console::AreaCommand area;
    const std::optional<std::string> packet = controller_message(puts[i], 1);
    if (packet && packet->size() == sizeof(area)) {
      std::memcpy(&area, packet->data(), sizeof(area));
    }
    if (board.put(area) != console::Verdict::kAccepted) {
      return Error{
          "areas.geojson: feature " + std::to_string(i + 1) +
          ": lies off the map, is no area, or is one too many of its agent; expected areas on the map, at most " +
          std::to_string(limits::kAreas) + " of a kind for each agent"};
    }
  }
  return {};
}

}  // namespace

std::optional<std::string> areas_geojson(const View& view) {
  const std::optional<std::vector<DrawnArea>> areas = areas_of_controller(view);
  return areas ? std::optional(geojson_text(*areas)) : std::nullopt;
}

Result<std::vector<Request>> requests_of_geojson(const std::string& text, const View& view) {
  const std::optional<MissionFacts> facts = facts_of(view);
  const std::optional<std::vector<DrawnArea>> before = areas_of_controller(view);
  if (!facts || !before) {
    return Error{"areas: no mission is known; expected a controller that runs"};
  }
  const Result<std::vector<DrawnArea>> areas = parse_geojson(text, "areas.geojson", facts->agents);
  if (!areas) {
    return areas.error();
  }
  Slots taken{};
  for (const DrawnArea& area : areas.value()) {
    if (area.slot) {
      taken.at(static_cast<std::size_t>(*area.slot)) = true;
    }
  }
  std::vector<Request> puts;
  for (const DrawnArea& area : areas.value()) {
    const auto free = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    const std::size_t slot = area.slot ? static_cast<std::size_t>(*area.slot) : free;
    if (slot >= taken.size()) {
      return Error{"areas.geojson: holds more areas than there are slots; expected at most " +
                   std::to_string(taken.size())};
    }
    taken.at(slot) = true;
    puts.emplace_back(request_of_area(area, static_cast<std::uint8_t>(slot), facts->agents));
  }
  if (const Result<void> judged = judge_areas(puts, *facts); !judged) {
    return judged.error();
  }
  std::vector<Request> requests;
  for (const DrawnArea& area : *before) {
    if (area.slot && !taken.at(static_cast<std::size_t>(*area.slot))) {
      requests.emplace_back(RemoveArea{static_cast<std::uint8_t>(*area.slot)});
    }
  }
  requests.insert(requests.end(), puts.begin(), puts.end());
  return requests;
}

std::optional<KeepoutMask> keepout_of(const View& view) {
  const std::optional<MissionFacts> facts = facts_of(view);
  const KnownDocument& map = view.document(Document::kMap);
  const std::size_t pixels =
      facts ? static_cast<std::size_t>(facts->width_px) * static_cast<std::size_t>(facts->height_px) : 0;
  if (pixels == 0 || !map.there() || map.bytes->size() != pixels) {
    return std::nullopt;
  }
  std::vector<std::uint8_t> obstacles(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto cls = static_cast<std::uint8_t>((*map.bytes)[i]);
    obstacles[i] = cls >= facts->obstacle.size() || facts->obstacle[cls] ? 1 : 0;
  }
  std::vector<Polygon> no_go;
  for (const DrawnArea& area : areas_of_controller(view).value_or(std::vector<DrawnArea>{})) {
    // A person's are open to the robot, which is the mission's first agent.
    if (area.purpose == DrawnPurpose::kNoGo && (!area.agent || *area.agent == facts->agents.front())) {
      no_go.push_back(area.polygon);
    }
  }
  return keepout_mask({.width_px = facts->width_px,
                       .height_px = facts->height_px,
                       .resolution_m = facts->resolution_m,
                       .origin_m = facts->origin_m,
                       .obstacles = obstacles,
                       .no_go = no_go},
                      "keepout.pgm");
}

}  // namespace ivo::firmware::web
