#include "firmware/files/ros_map_file.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "firmware/files/class_file.hpp"
#include "firmware/files/flat_yaml.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/pgm_file.hpp"
#include "firmware/files/png_file.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {
namespace {

enum class MapMode : std::uint8_t { kTrinary, kScale, kRaw };

struct MapKeys {
  std::string image;
  double resolution_m = 0.0;
  Point origin_m;
  bool negate = false;
  double occupied = 0.0;
  double free = 0.0;
  MapMode mode = MapMode::kTrinary;
};

/// Reads key by key and keeps the first fault.
class MapReading {
 public:
  explicit MapReading(const FlatYaml& yaml) : yaml_(yaml) {}

  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }

  std::string text(std::string_view key) {
    const YamlEntry* const entry = required(key);
    if (entry == nullptr || entry->list || entry->values.front().empty()) {
      complain(key, "is no text; expected one");
      return {};
    }
    return entry->values.front();
  }
  double number(std::string_view key, double least, double most) {
    const YamlEntry* const entry = required(key);
    return entry == nullptr || entry->list ? refused(key, "is no number; expected one")
                                           : number_of(key, entry->values.front(), least, most);
  }
  bool flag(std::string_view key) {
    const std::string word = text(key);
    const bool set = word == "1" || word == "true" || word == "True";
    if (!set && word != "0" && word != "false" && word != "False") {
      complain(key, "\"" + word + "\" will not do; expected 0, 1, false or true");
    }
    return set;
  }
  MapMode mode() {
    if (yaml_.entry("mode") == nullptr) {
      return MapMode::kTrinary;
    }
    const std::string word = text("mode");
    if (word != "trinary" && word != "scale" && word != "raw") {
      complain("mode", "\"" + word + "\" is unknown; expected trinary, scale or raw");
    }
    return word == "raw" ? MapMode::kRaw : word == "scale" ? MapMode::kScale : MapMode::kTrinary;
  }
  Point origin() {
    constexpr double kFar = 1e6;
    const YamlEntry* const entry = required("origin");
    if (entry == nullptr || !entry->list || entry->values.size() != 3) {
      complain("origin", "is no pose; expected [x, y, yaw]");
      return {};
    }
    const Point origin{number_of("origin", entry->values[0], -kFar, kFar),
                       number_of("origin", entry->values[1], -kFar, kFar)};
    const double yaw_rad = number_of("origin", entry->values[2], -kFar, kFar);
    if (yaw_rad != 0.0) {
      complain("origin", "is turned by a yaw of " + shortest(yaw_rad) + " rad; expected 0, a map that is not turned");
    }
    return origin;
  }
  void complain(std::string_view key, std::string_view what) {
    if (!fault_) {
      fault_ = yaml_.at(key, what);
    }
  }

 private:
  const YamlEntry* required(std::string_view key) {
    const YamlEntry* const entry = yaml_.entry(key);
    if (entry == nullptr) {
      complain(key, "missing; it must be given");
    }
    return entry;
  }
  double refused(std::string_view key, std::string_view what) {
    complain(key, what);
    return 0.0;
  }
  double number_of(std::string_view key, const std::string& text, double least, double most) {
    const std::optional<double> value = yaml_number(text, least, most);
    return value ? *value
                 : refused(key, "\"" + text + "\" will not do; expected a number, " + shortest(least) + " to " +
                                    shortest(most));
  }

  const FlatYaml& yaml_;
  std::optional<Error> fault_;
};

struct OccupancyImage {
  int width_px = 0;
  int height_px = 0;
  double white = 255.0;
  std::vector<double> values;
};

Result<OccupancyImage> read_image(const std::string& path) {
  if (path.ends_with(".png") || path.ends_with(".PNG")) {
    const Result<ColourImage> png = read_colours(path);
    if (!png) {
      return png.error();
    }
    if (png.value().alpha) {
      return Error{path + ": has transparent pixels; expected an opaque image, grey for unknown"};
    }
    OccupancyImage image{png.value().width_px, png.value().height_px, 255.0, {}};
    image.values.reserve(png.value().pixels.size());
    for (const Colour c : png.value().pixels) {
      image.values.push_back((c.r + c.g + c.b) / 3.0);
    }
    return image;
  }
  const Result<std::string> bytes = read_file(path);
  if (!bytes) {
    return bytes.error();
  }
  const Result<PgmImage> pgm = parse_pgm(bytes.value(), path);
  if (!pgm) {
    return pgm.error();
  }
  const GreyImage& grey = pgm.value().grey;
  return OccupancyImage{
      grey.width_px, grey.height_px, static_cast<double>(pgm.value().white), {grey.values.begin(), grey.values.end()}};
}

SemanticClass class_of(double value, double white, const MapKeys& keys) {
  using enum SemanticClass;
  double occupancy = keys.negate ? value / white : (white - value) / white;
  if (keys.mode == MapMode::kRaw) {
    if (value > 100.0) {
      return kBuilding;  // the 255 of what is unknown, or no occupancy at all
    }
    occupancy = value / 100.0;
  }
  return occupancy >= keys.occupied ? kWall : occupancy <= keys.free ? kPavement : kBuilding;
}

}  // namespace

Result<MapFile> read_ros_map(const std::string& path) {
  const Result<std::string> text = read_file(path);
  if (!text) {
    return text.error();
  }
  const Result<FlatYaml> yaml = FlatYaml::parse(
      text.value(), path, {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"});
  if (!yaml) {
    return yaml.error();
  }
  MapReading reading(yaml.value());
  MapKeys keys;
  keys.image = reading.text("image");
  keys.resolution_m = reading.number("resolution", 0.001, 100.0);
  keys.origin_m = reading.origin();
  keys.negate = reading.flag("negate");
  keys.occupied = reading.number("occupied_thresh", 0.0, 1.0);
  keys.free = reading.number("free_thresh", 0.0, 1.0);
  keys.mode = reading.mode();
  if (keys.free >= keys.occupied) {
    reading.complain("free_thresh", "is not below occupied_thresh; expected free_thresh < occupied_thresh");
  }
  if (reading.fault()) {
    return *reading.fault();
  }

  MapFile map;
  map.path = path;
  map.image_path = beside(path, keys.image);
  map.resolution_m = keys.resolution_m;
  map.origin_m = keys.origin_m;
  const Result<OccupancyImage> image = read_image(map.image_path);
  if (!image) {
    return yaml.value().at("image", image.error().message);
  }
  map.width_px = image.value().width_px;
  map.height_px = image.value().height_px;
  map.classes = built_in_classes().classes;
  map.pixels.reserve(image.value().values.size());
  for (const double value : image.value().values) {
    map.pixels.push_back(class_of(value, image.value().white, keys));
  }
  return map;
}

}  // namespace ivo::firmware
