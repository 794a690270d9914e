// Readers of files that other tools make: areas as GeoJSON, a map's YAML, its PGM. The first byte chooses. What is
// accepted keeps the promises of their headers.
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/files/flat_yaml.hpp"
#include "firmware/files/geojson_file.hpp"
#include "firmware/files/pgm_file.hpp"
#include "firmware/files/polygon_checks.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo;
using namespace ivo::firmware;
using fuzz::require;

const std::vector<std::string> kFuzzDrawers = {"IVO", "Ana"};

template <class T>
bool accepted(const Result<T>& result) {
  if (!result.ok()) {
    const std::string& message = result.error().message;
    require(!message.empty() && message.find('\n') == std::string::npos, "a refusal is one line");
  }
  return result.ok();
}

void read_areas(std::string_view text) {
  const auto areas = parse_geojson(text, "a", kFuzzDrawers);
  if (!accepted(areas)) {
    return;
  }
  require(areas.value().size() <= kDrawnAreas, "areas have an end");
  for (const DrawnArea& area : areas.value()) {
    require(area.polygon.size() >= 3 && area.polygon.size() <= 64 && !fault_of(area.polygon), "an area is simple");
    require(area.agent.has_value() || area.purpose == DrawnPurpose::kNoGo, "a preferred area is somebody's");
  }
  const auto again = parse_geojson(geojson_text(areas.value()), "a", kFuzzDrawers);
  require(accepted(again) && again.value() == areas.value(), "what is written reads back the same");
}

void read_yaml(std::string_view text) {
  const auto yaml = FlatYaml::parse(text, "a", {"image", "origin", "mode"});
  if (accepted(yaml)) {
    for (const char* key : {"image", "origin", "mode"}) {
      const YamlEntry* const entry = yaml.value().entry(key);
      require(entry == nullptr || entry->list || entry->values.size() == 1, "a scalar is one");
    }
  }
}

void read_pgm(std::string_view bytes) {
  const auto image = parse_pgm(bytes, "a");
  if (!accepted(image)) {
    return;
  }
  const GreyImage& grey = image.value().grey;
  require(grey.values.size() == static_cast<std::size_t>(grey.width_px) * static_cast<std::size_t>(grey.height_px),
          "an image is whole");
  for (const std::uint16_t value : grey.values) {
    require(value <= image.value().white, "nothing is whiter than white");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 3) {
    case 0:
      read_areas(rest);
      break;
    case 1:
      read_yaml(rest);
      break;
    default:
      read_pgm(rest);
      break;
  }
  return 0;
}
