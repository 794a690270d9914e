#include "firmware/tools/dialogue/shown_documents.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "config/semantic_class.hpp"
#include "firmware/files/class_file.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/tools/dialogue/drawn_areas.hpp"
#include "firmware/tools/preferred_share.hpp"
#include "planner/numeric/scalar.hpp"

namespace ivo::firmware {
namespace {

Json classes_json(const ClassTable& classes) {
  Json list = Json::list();
  for (std::size_t i = 0; i < classes.size(); ++i) {
    list.elements.push_back({{"name", std::string(name_of(static_cast<SemanticClass>(i)))},
                             {"colour", hex(classes[i].colour)},
                             {"obstacle", classes[i].obstacle}});
  }
  return list;
}

Json agents_json(const Mission& mission) {
  Json list = Json::list();
  for (const AgentSpec& agent : mission.agents) {
    const bool person = agent.kind == AgentKind::kPerson;
    const char* const motion = agent.motion == PersonMotion::kReported ? "reported" : "simulated";
    list.elements.push_back({{"name", agent.name},
                             {"kind", kAgentKindWords[static_cast<std::size_t>(agent.kind)]},
                             {"motion", person ? motion : ""},
                             {"start_m", agent.start},
                             {"heading_rad", agent.heading_rad},
                             {"speed_mps", agent.speed_mps},
                             {"sight_radius_m", agent.sight_radius_m}});
  }
  return list;
}

planner::Areas planner_areas(const std::vector<Polygon>& polygons) {
  planner::Areas areas;
  for (const Polygon& polygon : polygons) {
    planner::Area area;
    for (const Point corner : polygon) {
      (void)area.push_back(corner);
    }
    (void)areas.push_back(area);
  }
  return areas;
}

Json json_of(const planner::AgentPath& path, const AgentSpec& agent) {
  Json waypoints = Json::list();
  for (const Point waypoint : path.waypoints) {
    waypoints.elements.emplace_back(waypoint);
  }
  Json json{{"length_m", path.length_m},
            {"duration_s", path.duration_s},
            {"preferred_share", Json()},
            {"waypoints_m", waypoints}};
  if (!agent.preferred.empty()) {
    json.members[2].second = share_inside(path.waypoints.span(), path.length_m, planner_areas(agent.preferred));
  }
  return json;
}

double mass_within(const planner::Cells& cells, const SearchedMap& searched, const Polygon& border) {
  planner::Area area;
  for (const Point corner : border) {
    (void)area.push_back(corner);
  }
  const auto [west, east] = std::ranges::minmax(border, {}, &Point::x_m);
  const auto [south, north] = std::ranges::minmax(border, {}, &Point::y_m);
  const auto line = [&](double at_m, int count) {
    return static_cast<int>(std::clamp(at_m / cells.cell_m(), 0.0, static_cast<double>(count - 1)));
  };
  double mass = 0.0;
  for (int row = line(south.y_m, cells.rows()); row <= line(north.y_m, cells.rows()); ++row) {
    for (int column = line(west.x_m, cells.columns()); column <= line(east.x_m, cells.columns()); ++column) {
      if (planner::contains(area, cells.centre(column, row))) {
        mass += searched.share(cells.at(column, row));
      }
    }
  }
  return mass;
}

}  // namespace

std::string mission_text(const PlanView& view) {
  const Mission& mission = view.inputs.file.mission;
  const MapFile& map = view.inputs.map;
  const planner::SegmentedMap shape = map.view();
  const planner::Cells& cells = view.planner.cells();
  return json_text({{"name", mission.name},
                    {"map",
                     {{"width_m", shape.width_m()},
                      {"height_m", shape.height_m()},
                      {"width_px", map.width_px},
                      {"height_px", map.height_px},
                      {"resolution_m", map.resolution_m},
                      {"origin_m", map.origin_m},
                      {"aerial", !map.aerial_path.empty()}}},
                    {"cells", {{"columns", cells.columns()}, {"rows", cells.rows()}, {"cell_m", cells.cell_m()}}},
                    {"classes", classes_json(map.classes)},
                    {"agents", agents_json(mission)}});
}

std::string map_bytes(const MapFile& map) {
  std::string bytes(map.pixels.size(), '\0');
  std::transform(map.pixels.begin(), map.pixels.end(), bytes.begin(),
                 [](SemanticClass pixel) { return static_cast<char>(pixel); });
  return bytes;
}

std::string probability_bytes(const planner::Planner& planner) {
  const auto count = static_cast<std::size_t>(planner.cells().count());
  std::string bytes(count * sizeof(float), '\0');
  for (std::size_t c = 0; c < count; ++c) {
    const auto mass = static_cast<float>(planner::to_double(planner.belief().mass[c]));
    std::memcpy(bytes.data() + c * sizeof(float), &mass, sizeof(mass));
  }
  return bytes;
}

std::string searched_bytes(const planner::Cells& cells, const planner::CellSet& searched) {
  const auto count = static_cast<std::size_t>(cells.count());
  std::string bytes((count + 7) / 8, '\0');
  std::memcpy(bytes.data(), searched.words().data(), bytes.size());
  return bytes;
}

std::string plan_text(const PlanView& view, const ShownPlan& shown, const PlanAreas& areas) {
  const Mission& mission = view.inputs.file.mission;
  Json agents = Json::list();
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    agents.elements.push_back(json_of(shown.plan.paths[m], mission.agents[m]));
  }
  return json_text({{"number", static_cast<std::uint64_t>(shown.number)},
                    {"with_preferences", areas.preferred},
                    {"areas_revision", static_cast<std::uint64_t>(areas.revision)},
                    {"done", shown.ready},
                    {"generation", shown.generation},
                    {"generations", shown.generations},
                    {"score", json_of(score_document(view, shown.plan.score))},
                    {"gap", json_or_null(bounds_of(view, shown.plan.score).gap)},
                    {"agents", agents}});
}

std::string areas_text(const console::AreaBoard& board, const planner::Cells& cells, const SearchedMap& searched) {
  Json areas = Json::list();
  for (std::size_t slot = 0; slot < board.slots().size(); ++slot) {
    const auto& area = board.slots()[slot];
    if (!area) {
      continue;
    }
    const Polygon border = border_of(*area);
    Json corners = Json::list();
    for (const Point corner : border) {
      corners.elements.emplace_back(corner);
    }
    const bool everybody = area->agent == console::AreaCommand::kEverybody;
    areas.elements.push_back({{"slot", static_cast<std::uint64_t>(slot)},
                              {"purpose", area->purpose == console::AreaPurpose::kNoGo ? "no_go" : "preferred"},
                              {"agent", everybody ? Json() : Json(static_cast<std::uint64_t>(area->agent))},
                              {"polygon_m", corners},
                              {"share", mass_within(cells, searched, border)},
                              {"area_m2", area_m2(border)}});
  }
  return json_text({{"areas", areas}});
}

std::string notice_text(const PlanNotice& notice, std::uint32_t number) {
  return json_text({{"number", static_cast<std::uint64_t>(number)},
                    {"code", notice.code},
                    {"agent", json_or_null(notice.agent)},
                    {"slot", json_or_null(notice.slot)},
                    {"text", notice.text}});
}

}  // namespace ivo::firmware
