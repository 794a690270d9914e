#include "firmware/tools/console/drawn_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>

#include "firmware/console/verdict_text.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {

console::AreaCommand command_of(const DrawnArea& area, const std::vector<std::string>& names, std::uint8_t slot) {
  console::AreaCommand command;
  command.slot = area.slot ? static_cast<std::uint8_t>(*area.slot) : slot;
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

Result<void> draw_file(console::ConsoleClient& client, const std::string& path, const std::vector<std::string>& names) {
  const Result<std::string> text = read_file(path);
  if (!text) {
    return text.error();
  }
  const Result<std::vector<DrawnArea>> areas = parse_geojson(text.value(), path, names);
  if (!areas) {
    return areas.error();
  }
  std::set<int> taken;
  for (const DrawnArea& area : areas.value()) {
    if (area.slot) {
      taken.insert(*area.slot);
    }
  }
  for (int slot = 0; slot < console::kAreaSlots; ++slot) {
    if (const Result<console::Verdict> removed =
            client.command(console::Kind::kRemoveArea, 0, static_cast<std::uint32_t>(slot));
        !removed) {
      return removed.error();
    }
  }
  int free = 0;
  for (std::size_t i = 0; i < areas.value().size(); ++i) {
    while (taken.contains(free)) {
      ++free;
    }
    const DrawnArea& area = areas.value()[i];
    const Result<console::Verdict> verdict = client.put(command_of(area, names, static_cast<std::uint8_t>(free)));
    free += area.slot ? 0 : 1;
    if (!verdict) {
      return verdict.error();
    }
    if (verdict.value() != console::Verdict::kAccepted) {
      return Error{path + ": feature " + std::to_string(i) + " is not drawn: " + std::string(name_of(verdict.value())) +
                   "; expected an area on the map, and at most 16 of a kind for each agent"};
    }
  }
  return {};
}

}  // namespace ivo::firmware
