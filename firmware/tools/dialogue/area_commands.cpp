#include "firmware/tools/dialogue/area_commands.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>

namespace ivo::firmware {
namespace {

console::AreaCommand command_of(const DrawnArea& area, const std::vector<std::string>& names, int slot) {
  console::AreaCommand command;
  command.slot = static_cast<std::uint8_t>(slot);
  command.purpose =
      area.purpose == DrawnPurpose::kNoGo ? console::AreaPurpose::kNoGo : console::AreaPurpose::kPreferred;
  command.agent = console::AreaCommand::kEverybody;
  if (area.agent) {
    command.agent = static_cast<std::uint8_t>(std::ranges::find(names, *area.agent) - names.begin());
  }
  command.corners = static_cast<std::uint8_t>(area.polygon.size());
  for (std::size_t i = 0; i < area.polygon.size(); ++i) {
    command.corner[i] = {area.polygon[i].x_m, area.polygon[i].y_m};
  }
  return command;
}

}  // namespace

std::vector<console::AreaCommand> area_commands(const std::vector<DrawnArea>& areas,
                                                const std::vector<std::string>& names) {
  std::set<int> taken;
  for (const DrawnArea& area : areas) {
    if (area.slot) {
      taken.insert(*area.slot);
    }
  }
  std::vector<console::AreaCommand> commands;
  int free = 0;
  for (const DrawnArea& area : areas) {
    while (!area.slot && taken.contains(free)) {
      ++free;
    }
    commands.push_back(command_of(area, names, area.slot ? *area.slot : free++));
  }
  return commands;
}

}  // namespace ivo::firmware
