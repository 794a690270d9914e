#include "firmware/files/geojson_file.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "config/limits.hpp"
#include "firmware/files/json_reading.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/files/polygon_checks.hpp"

namespace ivo::firmware {
namespace {

constexpr std::array<const char*, 2> kPurposeWords = {"preferred", "no_go"};

Json feature_of(const DrawnArea& area) {
  Json ring = Json::list();
  for (const Point corner : area.polygon) {
    ring.elements.emplace_back(corner);
  }
  ring.elements.emplace_back(area.polygon.front());
  Json rings = Json::list();
  rings.elements.push_back(std::move(ring));
  Json properties{{"purpose", kPurposeWords[static_cast<std::size_t>(area.purpose)]},
                  {"agent", json_or_null(area.agent)}};
  if (area.slot) {
    properties.members.emplace_back("slot", *area.slot);
  }
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", "Polygon"}, {"coordinates", std::move(rings)}}}};
}

/// A member that, where it is there, must be this word.
void expect_word(JsonReading& reading, const Json& object, const std::string& at, const char* key, const char* word) {
  const Json* const value = object.member(key);
  if (value == nullptr || value->kind != Json::Kind::kText || value->text != word) {
    reading.fault(at + key, std::string(value == nullptr                   ? "missing"
                                        : value->kind == Json::Kind::kText ? shown_text(value->text) + " will not do"
                                                                           : "is no text") +
                                "; expected \"" + word + "\"");
  }
}

Polygon polygon_of(JsonReading& reading, const Json& geometry, const std::string& at) {
  expect_word(reading, geometry, at, "type", "Polygon");
  const Json& rings = reading.list(geometry, at, "coordinates");
  const std::string name = at + "coordinates";
  if (rings.elements.size() != 1) {
    reading.fault(name, "has " + std::to_string(rings.elements.size()) + " rings; expected one, an area has no holes");
    return {};
  }
  const std::vector<Json>& ring = rings.elements.front().elements;
  constexpr std::size_t kMost = limits::kPolygonVertices;
  if (ring.size() < 4 || ring.size() > kMost + 1) {
    reading.fault(name, "has a ring of " + std::to_string(ring.size()) + " positions; expected 4 to " +
                            std::to_string(kMost + 1) + ", the last as the first");
    return {};
  }
  Polygon polygon;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    polygon.push_back(reading.point(ring[i], element(element(name, 0), i)));
  }
  if (reading.ok() && polygon.front() != polygon.back()) {
    reading.fault(name, "has a ring that is not closed; expected its last position as its first");
  }
  polygon.pop_back();
  if (reading.ok()) {
    if (const std::optional<std::string> fault = fault_of(polygon)) {
      reading.fault(name, *fault);
    }
  }
  return polygon;
}

std::optional<std::string> agent_of(JsonReading& reading, const Json& properties, const std::string& at,
                                    const std::vector<std::string>& agents, DrawnPurpose purpose) {
  const Json* const value = reading.field(properties, at, "agent");
  if (value != nullptr && value->kind == Json::Kind::kNull) {
    if (purpose == DrawnPurpose::kPreferred) {
      reading.fault(at + "agent", "is null; expected whose preferred area it is, everybody has no-go areas alone");
    }
    return std::nullopt;
  }
  const std::string name = reading.text(properties, at, "agent");
  if (std::find(agents.begin(), agents.end(), name) == agents.end()) {
    std::string all;
    for (const std::string& agent : agents) {
      all += (all.empty() ? "" : ", ") + agent;
    }
    reading.fault(at + "agent", shown_text(name) + " is unknown; expected one of " + all);
  }
  return name;
}

DrawnArea area_of(JsonReading& reading, const Json& feature, const std::string& at,
                  const std::vector<std::string>& agents) {
  DrawnArea area;
  expect_word(reading, feature, at, "type", "Feature");
  const Json* const properties = reading.field(feature, at, "properties");
  const Json* const geometry = reading.field(feature, at, "geometry");
  if (properties == nullptr || geometry == nullptr) {
    return area;
  }
  area.purpose = static_cast<DrawnPurpose>(reading.choice(*properties, at + "properties.", "purpose", kPurposeWords));
  area.agent = agent_of(reading, *properties, at + "properties.", agents, area.purpose);
  if (const Json* const slot = properties->member("slot"); slot != nullptr && slot->kind != Json::Kind::kNull) {
    area.slot = static_cast<int>(reading.count(*properties, at + "properties.", "slot", kDrawnAreas - 1));
  }
  area.polygon = polygon_of(reading, *geometry, at + "geometry.");
  return area;
}

void check_frame(JsonReading& reading, const Json& root) {
  if (root.member("frame") != nullptr) {
    expect_word(reading, root, "", "frame", "map");
  }
  if (root.member("unit") != nullptr) {
    expect_word(reading, root, "", "unit", "metre");
  }
  if (root.member("crs") != nullptr) {
    reading.fault("crs", "names a reference system; expected none, positions are metres of the map's frame");
  }
}

}  // namespace

std::string geojson_text(const std::vector<DrawnArea>& areas) {
  Json features = Json::list();
  for (const DrawnArea& area : areas) {
    features.elements.push_back(feature_of(area));
  }
  return json_text(
      {{"type", "FeatureCollection"}, {"frame", "map"}, {"unit", "metre"}, {"features", std::move(features)}});
}

Result<std::vector<DrawnArea>> parse_geojson(std::string_view text, const std::string& path,
                                             const std::vector<std::string>& agents) {
  const Result<Json> json = parse_json(text, path, "areas as GeoJSON");
  if (!json) {
    return json.error();
  }
  const Json& root = json.value();
  JsonReading reading(path);
  expect_word(reading, root, "", "type", "FeatureCollection");
  check_frame(reading, root);
  const Json* const features = reading.field(root, "", "features");
  if (features == nullptr || features->kind != Json::Kind::kList || features->elements.size() > kDrawnAreas) {
    reading.fault("features", "is no list of at most " + std::to_string(kDrawnAreas) + "; expected an area a feature");
    return reading.error();
  }
  std::vector<DrawnArea> areas;
  std::set<int> slots;
  for (std::size_t i = 0; i < features->elements.size() && reading.ok(); ++i) {
    const std::string name = element("features", i);
    areas.push_back(area_of(reading, features->elements[i], name + ".", agents));
    if (areas.back().slot && !slots.insert(*areas.back().slot).second) {
      reading.fault(name + ".properties.slot",
                    std::to_string(*areas.back().slot) + " is taken by an earlier feature; expected each slot once");
    }
  }
  if (!reading.ok()) {
    return reading.error();
  }
  return areas;
}

}  // namespace ivo::firmware
