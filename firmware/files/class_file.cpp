#include "firmware/files/class_file.hpp"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/files/toml_table.hpp"

namespace ivo::firmware {
namespace {

std::string all_class_names() {
  std::string names;
  for (int i = 0; i < kClasses; ++i) {
    names.append(names.empty() ? "" : ", ").append(name_of(static_cast<SemanticClass>(i)));
  }
  return names;
}

Colour read_colour(const TomlValue& value) {
  if (value.is_text()) {
    const std::string text = value.text();
    std::uint32_t rgb = 0;
    const char* const end = text.data() + text.size();
    if (text.size() == 7 && text[0] == '#') {
      const auto [stop, status] = std::from_chars(text.data() + 1, end, rgb, 16);
      if (status == std::errc() && stop == end) {
        return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 0xff),
                static_cast<std::uint8_t>(rgb & 0xff)};
      }
    }
    value.complain("\"" + text + "\" is no colour; expected \"#rrggbb\" or [r, g, b]");
    return {};
  }
  const std::vector<TomlValue> rgb = value.items(3, 3, "numbers, [r, g, b], or \"#rrggbb\"");
  if (rgb.size() != 3) {
    return {};
  }
  const auto level = [](const TomlValue& v) { return static_cast<std::uint8_t>(v.integer(0, 255)); };
  return {level(rgb[0]), level(rgb[1]), level(rgb[2])};
}

void read_class(const TomlValue& entry, ClassFile& file) {
  const TomlValue name = entry.required("name");
  const std::string name_text = name.text();
  const TomlValue colour = entry.required("colour");
  ClassProperties properties;
  properties.colour = read_colour(colour);
  const std::optional<SemanticClass> named = class_named(name_text);
  const auto index = static_cast<std::size_t>(named.value_or(SemanticClass::kPavement));
  if (name.present() && !named) {
    name.complain("\"" + name_text + "\" is no class; expected one of " + all_class_names());
  }
  if (named && file.listed[index]) {
    name.complain("\"" + name_text + "\" is listed twice; expected each class once");
  }
  const ClassProperties built_in = default_class_table()[index];
  properties.obstacle = entry.optional("obstacle").flag(built_in.obstacle);
  properties.occluder = entry.optional("occluder").flag(built_in.occluder);
  properties.restricted = built_in.restricted;
  const TomlValue restricted = entry.optional("restricted");
  if (restricted.present()) {
    properties.restricted = {};
    for (const TomlValue& kind : restricted.items(0, kAgentKinds, "agent kinds")) {
      properties.restricted[kind.choice({"robot", "person"})] = true;
    }
  }
  for (std::size_t other = 0; other < file.listed.size(); ++other) {
    if (named && file.listed[other] && other != index && file.classes[other].colour == properties.colour) {
      colour.complain(hex(properties.colour) + " is already the colour of " +
                      std::string(name_of(static_cast<SemanticClass>(other))) + "; expected a colour of its own");
    }
  }
  if (named) {
    file.listed[index] = true;
    file.classes[index] = properties;
  }
}

}  // namespace

ClassFile built_in_classes() {
  ClassFile file;
  file.classes = default_class_table();
  file.listed.fill(true);
  return file;
}

Result<ClassFile> read_classes(const std::string& path) {
  const Result<TomlFile> toml = TomlFile::read(path);
  if (!toml) {
    return toml.error();
  }
  ClassFile file;
  file.classes = default_class_table();
  for (const TomlValue& entry : toml.value().root().required("class").items(1, 1000, "[[class]] entries")) {
    read_class(entry, file);
  }
  const Result<void> finish = toml.value().finish();
  if (!finish) {
    return finish.error();
  }
  return file;
}

std::string hex(Colour colour) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t level : {colour.r, colour.g, colour.b}) {
    text += kDigits[level >> 4];
    text += kDigits[level & 0xf];
  }
  return text;
}

}  // namespace ivo::firmware
