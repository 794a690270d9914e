#include "firmware/tools/doctor/watchdog_checks.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>

#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr double kLongestS = 60.0;  // a robot that hangs is back in a minute and a boot

constexpr const char* kDropIn =
    "\"[Manager]\" and \"RuntimeWatchdogSec=10\" in /etc/systemd/system.conf.d/ivo-watchdog.conf, then systemctl "
    "daemon-reexec";

constexpr std::array<std::pair<std::string_view, double>, 12> kUnits{{{"", 1.0},
                                                                      {"s", 1.0},
                                                                      {"sec", 1.0},
                                                                      {"second", 1.0},
                                                                      {"seconds", 1.0},
                                                                      {"ms", 1e-3},
                                                                      {"msec", 1e-3},
                                                                      {"us", 1e-6},
                                                                      {"m", 60.0},
                                                                      {"min", 60.0},
                                                                      {"minute", 60.0},
                                                                      {"minutes", 60.0}}};

std::string device_folder(const MachineFiles& files) {
  const std::string all = "/sys/class/watchdog";
  const std::vector<std::string> names = files.names(all);
  return names.empty() ? "" : all + "/" + names.front();
}

Finding device(const MachineFiles& files) {
  const std::string check = "device";
  const std::string folder = device_folder(files);
  if (folder.empty()) {
    return warning(check, "there is none: a machine that hangs stays so (the drives stop by themselves)",
                   "`modprobe iTCO_wdt` (Intel), `sp5100_tco` (AMD), or `softdog`; to keep it, its name in "
                   "/etc/modules-load.d/watchdog.conf");
  }
  const std::string name = folder.substr(folder.rfind('/') + 1);
  const std::string identity = files.text(folder + "/identity").value_or("not named");
  if (!files.there("/dev/" + name)) {
    return fault(check, identity + ", but " + absent("/dev/" + name), "`udevadm trigger --subsystem-match=watchdog`");
  }
  const std::string found = "/dev/" + name + ", " + identity;
  if (identity.find("Software Watchdog") != std::string::npos) {
    return warning(check, found + ": it hangs with the kernel",
                   "`modprobe iTCO_wdt` (Intel) or `sp5100_tco` (AMD) where the board has one");
  }
  return ok(check, found);
}

Finding feeder(const MachineFiles& files) {
  const std::string check = "systemd feeds it";
  if (!files.there("/etc/systemd/system.conf") && !files.there("/usr/lib/systemd/systemd") &&
      !files.there("/lib/systemd/systemd")) {
    return not_checked(check, "there is no systemd");
  }
  const std::string set = runtime_watchdog(files).value_or("");
  const std::optional<double> span = span_s(set);
  if (set == "default") {
    return ok(check, "RuntimeWatchdogSec=default, what the device has");
  }
  if (!span || *span <= 0.0) {
    return warning(check, set.empty() ? "RuntimeWatchdogSec is not set" : "RuntimeWatchdogSec=" + set, kDropIn);
  }
  const std::string found = "RuntimeWatchdogSec=" + set;
  return *span <= kLongestS ? ok(check, found)
                            : warning(check, found + format("; expected at most %.0f s", kLongestS), kDropIn);
}

Finding time_out(const MachineFiles& files) {
  const std::string check = "time-out";
  const std::string folder = device_folder(files);
  const std::optional<std::int64_t> seconds = folder.empty() ? std::nullopt : files.number(folder + "/timeout");
  if (!seconds) {
    return not_checked(check, folder.empty() ? "there is no device" : absent(folder + "/timeout"));
  }
  const bool active = files.text(folder + "/state").value_or("") == "active";
  const std::string found = format("%lld s, ", static_cast<long long>(*seconds)) + (active ? "running" : "not running");
  if (!active) {
    return warning(check, found, kDropIn);
  }
  return static_cast<double>(*seconds) <= kLongestS
             ? ok(check, found)
             : warning(check, found + format("; expected at most %.0f s", kLongestS), kDropIn);
}

}  // namespace

std::optional<std::string> runtime_watchdog(const MachineFiles& files) {
  constexpr std::string_view kKey = "RuntimeWatchdogSec=";
  constexpr std::array kFolders{"/usr/lib/systemd/", "/usr/local/lib/systemd/", "/run/systemd/", "/etc/systemd/"};
  std::vector<std::string> paths{"/etc/systemd/system.conf"};
  std::map<std::string, std::string> drop_ins;  // by name; a later folder hides the earlier
  for (const char* const folder : kFolders) {
    const std::string all = std::string(folder) + "system.conf.d";
    for (const std::string& name : files.names(all)) {
      if (name.ends_with(".conf")) {
        drop_ins[name] = format("%s/%s", all.c_str(), name.c_str());
      }
    }
  }
  for (const auto& [name, path] : drop_ins) {
    paths.push_back(path);
  }
  std::optional<std::string> set;
  for (const std::string& path : paths) {
    for (const std::string& line : files.lines(path)) {
      if (line.starts_with(kKey)) {
        set = line.substr(kKey.size());
      }
    }
  }
  return set;
}

std::optional<double> span_s(const std::string& text) {
  if (text.empty() || text == "off") {
    return 0.0;
  }
  double sum = 0.0;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    double value = 0.0;
    const auto [after, status] = std::from_chars(at, end, value);
    const bool digits = *at >= '0' && *at <= '9';  // "infinity" is a number too, of another kind
    if (!digits || status != std::errc()) {
      return std::nullopt;
    }
    const char* const unit_begin = std::find_if(after, end, [](char c) { return c != ' '; });
    const char* const unit_end = std::find_if(unit_begin, end, [](char c) { return c < 'a' || c > 'z'; });
    const std::string_view unit(unit_begin, static_cast<std::size_t>(unit_end - unit_begin));
    const auto* const known = std::ranges::find(kUnits, unit, &std::pair<std::string_view, double>::first);
    if (known == kUnits.end()) {
      return std::nullopt;
    }
    sum += value * known->second;
    at = std::find_if(unit_end, end, [](char c) { return c != ' '; });
  }
  return sum;
}

Group watchdog_checks(const MachineFiles& files) {
  return {"Watchdog of the machine", {device(files), feeder(files), time_out(files)}};
}

}  // namespace ivo::firmware::doctor
