#include "firmware/tools/doctor/idle_check.hpp"

#include <algorithm>
#include <cstring>
#include <optional>

#include "firmware/tools/doctor/kernel_command_line.hpp"
#include "firmware/tools/doctor/processor_checks.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr const char* kCheck = "idle states";

struct IdleState {
  std::string name;
  std::int64_t wake_up_us = 0;
};

/// The enabled state that takes longest to leave, of all `cpus`.
std::optional<IdleState> deepest(const MachineFiles& files, const std::vector<int>& cpus) {
  std::optional<IdleState> worst;
  for (const int cpu : cpus) {
    const std::string folder = "/sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/cpuidle";
    for (const std::string& state : files.names(folder)) {
      const std::string path = format("%s/%s", folder.c_str(), state.c_str());
      const std::optional<std::int64_t> latency = files.number(path + "/latency");
      if (latency && files.number(path + "/disable").value_or(0) == 0 && (!worst || *latency > worst->wake_up_us)) {
        worst = IdleState{files.text(path + "/name").value_or(state), *latency};
      }
    }
  }
  return worst;
}

/// The least that any program asks for, in us: a number of four bytes in the machine's order.
std::optional<std::int32_t> held(const MachineFiles& files) {
  const std::optional<std::string> bytes = files.bytes("/dev/cpu_dma_latency");
  std::int32_t us = 0;
  if (!bytes || bytes->size() != sizeof us) {
    return std::nullopt;
  }
  std::memcpy(&us, bytes->data(), sizeof us);
  return us;
}

}  // namespace

Finding idle_states(const MachineFiles& files, const std::vector<int>& cpus) {
  const std::string driver = files.text("/sys/devices/system/cpu/cpuidle/current_driver").value_or("");
  const std::optional<IdleState> worst = deepest(files, cpus);
  if (!worst) {
    return driver == "none" ? ok(kCheck, "none: the CPU waits awake, or halts")
                            : not_checked(kCheck, absent("/sys/devices/system/cpu/cpu*/cpuidle/state*"));
  }
  const std::string deep = worst->name + format(" takes %lld us to leave", static_cast<long long>(worst->wake_up_us));
  if (worst->wake_up_us <= kWakeUpUs) {
    return ok(kCheck, "the deepest, " + deep);
  }
  if (const std::optional<std::int32_t> limit = held(files); limit && *limit <= kWakeUpUs) {
    return ok(kCheck, format("held to %d us by a program, through /dev/cpu_dma_latency", *limit));
  }
  return warning(kCheck, deep + format("; expected at most %d", kWakeUpUs),
                 "`cpupower idle-set -D 50` (apt install linux-cpupower); at each boot: " +
                     add_to_command_line(files, "intel_idle.max_cstate=1 processor.max_cstate=1"));
}

}  // namespace ivo::firmware::doctor
