#include "firmware/files/map_file.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

#include "firmware/files/class_file.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/png_file.hpp"
#include "firmware/files/ros_map_file.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/files/toml_table.hpp"

namespace ivo::firmware {
namespace {

std::uint32_t packed(Colour c) {
  return static_cast<std::uint32_t>(c.r) << 16 | static_cast<std::uint32_t>(c.g) << 8 | c.b;
}

int distance_squared(Colour a, Colour b) {
  const int dr = a.r - b.r;
  const int dg = a.g - b.g;
  const int db = a.b - b.b;
  return dr * dr + dg * dg + db * db;
}

std::string nearest_class(Colour colour, const ClassFile& file) {
  std::size_t nearest = kClasses;
  for (std::size_t i = 0; i < file.listed.size(); ++i) {
    if (file.listed[i] && (nearest == kClasses || distance_squared(colour, file.classes[i].colour) <
                                                      distance_squared(colour, file.classes[nearest].colour))) {
      nearest = i;
    }
  }
  return std::string(name_of(static_cast<SemanticClass>(nearest))) + " " + hex(file.classes[nearest].colour);
}

/// Rows from the top, so that a complaint names the pixel that a person finds first.
Result<std::vector<SemanticClass>> classify(const ColourImage& image, const ClassFile& file, const MapFile& map) {
  std::unordered_map<std::uint32_t, SemanticClass> class_of;
  for (std::size_t i = 0; i < file.listed.size(); ++i) {
    if (file.listed[i]) {
      class_of.emplace(packed(file.classes[i].colour), static_cast<SemanticClass>(i));
    }
  }
  std::vector<SemanticClass> classes(image.pixels.size());
  std::optional<Colour> run_colour;
  SemanticClass run_class{};
  for (int row = image.height_px - 1; row >= 0; --row) {
    for (int column = 0; column < image.width_px; ++column) {
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) + static_cast<std::size_t>(column);
      const Colour colour = image.pixels[i];
      if (run_colour != colour) {
        const auto found = class_of.find(packed(colour));
        if (found == class_of.end()) {
          return Error{map.image_path + ": pixel in column " + std::to_string(column) + ", row " +
                       std::to_string(image.height_px - 1 - row) + " from the top (" +
                       shortest((column + 0.5) * map.resolution_m) + " m, " + shortest((row + 0.5) * map.resolution_m) +
                       " m) is " + hex(colour) +
                       ", the colour of no class; expected colours of the class table, the nearest is " +
                       nearest_class(colour, file)};
        }
        run_colour = colour;
        run_class = found->second;
      }
      classes[i] = run_class;
    }
  }
  return classes;
}

// It is shown stretched over the map: of another shape it would lie.
Result<void> read_aerial(const std::string& path, MapFile& map) {
  const Result<ColourImage> image = read_colours(path);
  if (!image) {
    return image.error();
  }
  const double shape = static_cast<double>(image.value().width_px) / image.value().height_px;
  const double expected = static_cast<double>(map.width_px) / map.height_px;
  if (std::abs(shape / expected - 1) > 0.02) {
    return Error{path + ": is " + std::to_string(image.value().width_px) + " x " +
                 std::to_string(image.value().height_px) + " pixels; expected the shape of the map, " +
                 std::to_string(map.width_px) + " x " + std::to_string(map.height_px)};
  }
  Result<std::string> bytes = read_file(path);
  if (!bytes) {
    return bytes.error();
  }
  map.aerial_path = path;
  map.aerial = std::move(bytes).value();
  return {};
}

}  // namespace

planner::SegmentedMap MapFile::view() const { return {pixels, width_px, height_px, resolution_m, classes}; }

Result<MapFile> read_map(const std::string& path) {
  if (path.ends_with(".yaml") || path.ends_with(".yml")) {
    return read_ros_map(path);
  }
  const Result<TomlFile> toml = TomlFile::read(path);
  if (!toml) {
    return toml.error();
  }
  const TomlValue root = toml.value().root();
  MapFile map;
  map.path = path;
  map.image_path = beside(path, root.required("image").text());
  map.resolution_m = root.required("resolution_m").number({0.001, 100.0, "metres a pixel"});
  const std::string classes = root.optional("classes").text();
  const std::string aerial = root.optional("aerial").text();
  const Result<void> finish = toml.value().finish();
  if (!finish) {
    return finish.error();
  }

  map.classes_path = classes.empty() ? "" : beside(path, classes);
  Result<ClassFile> table = classes.empty() ? built_in_classes() : read_classes(map.classes_path);
  if (!table) {
    return table.error();
  }
  const Result<ColourImage> image = read_colours(map.image_path);
  if (!image) {
    return toml.value().lines().at("image", image.error().message);
  }
  map.width_px = image.value().width_px;
  map.height_px = image.value().height_px;
  map.classes = table.value().classes;
  Result<std::vector<SemanticClass>> pixels = classify(image.value(), table.value(), map);
  if (!pixels) {
    return pixels.error();
  }
  map.pixels = std::move(pixels).value();
  if (!aerial.empty()) {
    if (const Result<void> read = read_aerial(beside(path, aerial), map); !read) {
      return toml.value().lines().at("aerial", read.error().message);
    }
  }
  return map;
}

}  // namespace ivo::firmware
