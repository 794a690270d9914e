#include "firmware/tools/doctor/kernel_checks.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "firmware/tools/doctor/kernel_command_line.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr const char* kInstall =
    "apt install linux-image-rt-amd64 (linux-image-rt-arm64 on ARM), then boot it: `uname -v` says PREEMPT_RT";

Finding real_time_kernel(const MachineFiles& files) {
  const std::string check = "real-time kernel";
  const std::string version = files.text("/proc/sys/kernel/version").value_or("");
  const std::string release = files.text("/proc/sys/kernel/osrelease").value_or("a release that it does not tell");
  const bool told = files.number("/sys/kernel/realtime").value_or(0) == 1;
  if (told || version.find("PREEMPT_RT") != std::string::npos) {
    return ok(check, "PREEMPT_RT, " + release);
  }
  if (version.empty()) {
    return not_checked(check, absent("/proc/sys/kernel/version"));
  }
  // "#1 SMP PREEMPT_DYNAMIC Debian ...", "#1 SMP Debian ...": the model, where the kernel names one.
  const std::vector<std::string> words = words_of(version);
  const auto model = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("PREEMPT"); });
  return fault(check, release + ", " + (model == words.end() ? "without preemption" : *model) + "; expected PREEMPT_RT",
               kInstall);
}

Finding hardware(const MachineFiles& files) {
  const std::string check = "hardware";
  const std::vector<std::string> lines = files.lines("/proc/cpuinfo");
  const auto line_of = [&](const std::string& key) {
    return std::ranges::find_if(lines, [&](const std::string& line) { return line.starts_with(key); });
  };
  if (lines.empty()) {
    return not_checked(check, absent("/proc/cpuinfo"));
  }
  const auto flags = line_of("flags");
  const std::vector<std::string> words = flags == lines.end() ? std::vector<std::string>() : words_of(*flags);
  const bool guest = std::ranges::find(words, "hypervisor") != words.end() || files.there("/sys/hypervisor/type");
  const auto model = line_of("model name");
  const std::string name = model == lines.end() ? "" : model->substr(std::min(model->size(), model->find(':') + 2));
  if (guest) {
    return warning(check, "a virtual machine" + (name.empty() ? name : ", " + name),
                   "times here are not those of a robot's PC: run `ivo doctor` there");
  }
  return ok(check, name.empty() ? "no virtual machine" : name);
}

Finding clock_source(const MachineFiles& files) {
  constexpr std::array<std::string_view, 2> kFast{"tsc", "arch_sys_counter"};
  const std::string check = "clock source";
  const std::string path = "/sys/devices/system/clocksource/clocksource0/current_clocksource";
  const std::optional<std::string> source = files.text(path);
  if (!source) {
    return not_checked(check, absent(path));
  }
  if (std::ranges::find(kFast, *source) != kFast.end()) {
    return ok(check, *source);
  }
  return warning(check,
                 *source + ": slow to read, or read through another kernel; expected tsc (arch_sys_counter on ARM)",
                 "`dmesg | grep -iE 'tsc|clocksource'` says why; newer firmware, or " +
                     add_to_command_line(files, "tsc=reliable"));
}

}  // namespace

Group kernel_checks(const MachineFiles& files) {
  return {"Kernel", {real_time_kernel(files), hardware(files), clock_source(files)}};
}

}  // namespace ivo::firmware::doctor
