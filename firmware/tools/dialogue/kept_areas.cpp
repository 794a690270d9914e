#include "firmware/tools/dialogue/kept_areas.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware/files/geojson_file.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/tools/dialogue/area_commands.hpp"
#include "firmware/tools/dialogue/drawn_areas.hpp"

namespace ivo::firmware {
namespace {

std::vector<std::string> agents_of(const Mission& mission) {
  std::vector<std::string> names;
  for (const AgentSpec& agent : mission.agents) {
    names.push_back(agent.name);
  }
  return names;
}

}  // namespace

Result<void> keep_areas(const std::string& path, const console::AreaBoard& board, const Mission& mission) {
  std::vector<DrawnArea> areas;
  for (std::size_t slot = 0; slot < board.slots().size(); ++slot) {
    const auto& drawn = board.slots()[slot];
    if (!drawn) {
      continue;
    }
    DrawnArea area;
    area.purpose = drawn->purpose == console::AreaPurpose::kNoGo ? DrawnPurpose::kNoGo : DrawnPurpose::kPreferred;
    if (drawn->agent != console::AreaCommand::kEverybody) {
      area.agent = mission.agents[drawn->agent].name;
    }
    area.slot = static_cast<int>(slot);
    area.polygon = border_of(*drawn);
    areas.push_back(area);
  }
  return write_file(path, geojson_text(areas));
}

Result<bool> draw_kept_areas(const std::string& path, const Mission& mission, console::ConsoleDesk& desk) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return false;
  }
  const Result<std::string> text = read_file(path);
  if (!text) {
    return text.error();
  }
  const std::vector<std::string> names = agents_of(mission);
  const Result<std::vector<DrawnArea>> areas = parse_geojson(text.value(), path, names);
  if (!areas) {
    return areas.error();
  }
  for (const console::AreaCommand& command : area_commands(areas.value(), names)) {
    (void)desk.put(command);
  }
  return true;
}

}  // namespace ivo::firmware
