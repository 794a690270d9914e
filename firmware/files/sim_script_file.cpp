#include "firmware/files/sim_script_file.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "drivers/sim/sim_fault_text.hpp"
#include "firmware/files/toml_table.hpp"
#include "firmware/files/wheel_keys.hpp"

namespace ivo::firmware {
namespace {

using drivers::SimScript;

constexpr std::size_t kAll = kWheels;

std::size_t read_wheel(const TomlValue& value) {
  return value.choice({kWheelKeys[0], kWheelKeys[1], kWheelKeys[2], kWheelKeys[3], "all"}, kAll);
}

drivers::SimFault read_fault(const TomlValue& value) {
  const std::string name = value.text();
  if (const auto fault = drivers::sim_fault_of(name)) {
    return *fault;
  }
  if (value.is_text()) {
    std::string expected;
    for (const std::string_view known : drivers::sim_fault_names()) {
      expected.append(expected.empty() ? "" : ", ").append(known);
    }
    value.complain("\"" + name + "\" is unknown; expected one of " + expected);
  }
  return drivers::SimFault::kSilent;
}

drivers::SimEvent read_event(const TomlValue& table) {
  constexpr std::int64_t kMostValue = std::numeric_limits<std::uint32_t>::max();
  drivers::SimEvent event;
  event.at = Instant(from_seconds(table.required("t_s").number({0.0, 1e6, "seconds"})));
  event.fault = read_fault(table.required("fault"));
  event.on = table.optional("on").flag(true);
  event.value = static_cast<std::uint32_t>(table.optional("value").integer(0, kMostValue));
  event.object.index = static_cast<std::uint16_t>(table.optional("index").integer(0, 0xFFFF));
  event.object.sub = static_cast<std::uint8_t>(table.optional("sub").integer(0, 0xFF));
  return event;
}

}  // namespace

Result<drivers::SimDrives::Scripts> read_sim_script(const std::string& path) {
  const Result<TomlFile> toml = TomlFile::read(path);
  if (!toml) {
    return toml.error();
  }
  const TomlValue root = toml.value().root();
  drivers::SimDrives::Scripts scripts;
  for (SimScript& script : scripts) {
    script.noise_counts = static_cast<std::uint32_t>(root.optional("noise_counts").integer(0, 10'000));
    script.seed = static_cast<std::uint32_t>(root.optional("seed").integer(1, 0xFFFF'FFFF, script.seed));
    script.coast_radps2 =
        root.optional("coast_radps2").number({0.0, 10'000.0, "radians a second squared"}, script.coast_radps2);
  }
  for (const TomlValue& table : root.optional("at").items(0, kWheels * SimScript::kEvents, "tables, [[at]]")) {
    const std::size_t wheel = read_wheel(table.required("drive"));
    const drivers::SimEvent event = read_event(table);
    for (std::size_t i = 0; i < scripts.size(); ++i) {
      if ((wheel == i || wheel == kAll) && !scripts[i].events.push_back(event)) {
        table.complain("one event too many of this drive; expected at most " + std::to_string(SimScript::kEvents));
      }
    }
  }
  const Result<void> finish = toml.value().finish();
  if (!finish) {
    return finish.error();
  }
  return scripts;
}

}  // namespace ivo::firmware
