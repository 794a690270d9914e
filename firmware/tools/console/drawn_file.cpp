#include "firmware/tools/console/drawn_file.hpp"

#include <cstddef>
#include <cstdint>

#include "firmware/console/verdict_text.hpp"
#include "firmware/files/geojson_file.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/tools/dialogue/area_commands.hpp"

namespace ivo::firmware {

Result<void> draw_file(console::ConsoleClient& client, const std::string& path, const std::vector<std::string>& names) {
  const Result<std::string> text = read_file(path);
  if (!text) {
    return text.error();
  }
  const Result<std::vector<DrawnArea>> areas = parse_geojson(text.value(), path, names);
  if (!areas) {
    return areas.error();
  }
  for (int slot = 0; slot < console::kAreaSlots; ++slot) {
    if (const Result<console::Verdict> removed =
            client.command(console::Kind::kRemoveArea, 0, static_cast<std::uint32_t>(slot));
        !removed) {
      return removed.error();
    }
  }
  const std::vector<console::AreaCommand> commands = area_commands(areas.value(), names);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const Result<console::Verdict> verdict = client.put(commands[i]);
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
