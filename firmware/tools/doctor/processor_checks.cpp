#include "firmware/tools/doctor/processor_checks.hpp"

#include <algorithm>
#include <map>

#include "firmware/tools/doctor/cpu_list.hpp"
#include "firmware/tools/doctor/idle_check.hpp"
#include "firmware/tools/doctor/interrupt_check.hpp"
#include "firmware/tools/doctor/kernel_command_line.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr const char* kCpus = "/sys/devices/system/cpu";
constexpr const char* kIsolated = "/sys/devices/system/cpu/isolated";

std::string cpu_text(int cpu) { return "CPU " + std::to_string(cpu); }

/// All that a CPU of its own needs, in one line: who lacks one of it mostly lacks them all.
std::string set_apart(const MachineFiles& files, int cpu) {
  const std::string n = std::to_string(cpu);
  return add_to_command_line(files, "isolcpus=" + n + " nohz_full=" + n + " rcu_nocbs=" + n);
}

/// How the loop's thread comes to be on it: a CPU that was set apart gets none but who binds itself to it.
std::string bind_to(int cpu, const std::string& robot_file) {
  return "cpu = " + std::to_string(cpu) + " under [loop] in " + robot_file;
}

std::vector<int> online(const MachineFiles& files) {
  return cpus_in(files.text(std::string(kCpus) + "/online").value_or(""));
}

/// As the kernel tells them, or else as it was asked.
std::vector<int> isolated_cpus(const MachineFiles& files) {
  return cpus_in(files.text(kIsolated).value_or(kernel_argument(files, "isolcpus")));
}

Finding there(const std::vector<int>& all, int cpu, const LoopCpu& loop) {
  const std::string check = "loop's CPU";
  if (!contains(all, cpu)) {
    return fault(check, cpu_text(cpu) + " is not there; there are " + list_text(all),
                 bind_to(all.back(), loop.robot_file) + ", or another of them");
  }
  if (loop.bound != cpu) {
    return warning(check, cpu_text(cpu) + " was asked about, but the loop is not bound to it",
                   bind_to(cpu, loop.robot_file));
  }
  return ok(check, cpu_text(cpu) + " of " + list_text(all));
}

/// Of a loop that is bound to no CPU: it shares one with other programs.
Finding unbound(const MachineFiles& files, const std::vector<int>& all, const std::string& robot_file) {
  const std::vector<int> apart = isolated_cpus(files);
  if (!apart.empty()) {
    return warning("loop's CPU", cpu_text(apart.back()) + " is isolated, but the loop is not bound to it",
                   bind_to(apart.back(), robot_file));
  }
  return warning("isolation", "none of CPU " + list_text(all) + " is isolated: the loop shares one with other programs",
                 set_apart(files, all.back()) + "; with " + bind_to(all.back(), robot_file));
}

Finding isolated(const MachineFiles& files, int cpu, const std::string& robot_file) {
  const std::string check = "isolation";
  if (!files.there(kIsolated) && kernel_argument(files, "isolcpus").empty()) {
    return not_checked(check, absent(kIsolated));
  }
  const std::vector<int> cpus = isolated_cpus(files);
  if (contains(cpus, cpu)) {
    return ok(check, "isolcpus: " + list_text(cpus));
  }
  return warning(check,
                 (cpus.empty() ? "no CPU is isolated" : "isolcpus: " + list_text(cpus)) + "; expected " +
                     std::to_string(cpu) + ", or other programs run beside the loop",
                 cpus.empty() ? set_apart(files, cpu) + "; with " + bind_to(cpu, robot_file)
                              : bind_to(cpus.back(), robot_file) + "; or " + set_apart(files, cpu));
}

Finding tickless(const MachineFiles& files, int cpu) {
  const std::string check = "timer tick";
  const std::string path = std::string(kCpus) + "/nohz_full";
  const std::optional<std::string> told = files.text(path);
  const std::string asked = kernel_argument(files, "nohz_full");
  if (!told && asked.empty()) {
    return not_checked(check, absent(path) + ": this kernel was built without CONFIG_NO_HZ_FULL");
  }
  const std::vector<int> cpus = cpus_in(told.value_or(asked));  // "(null)" where there are none
  if (contains(cpus, cpu)) {
    return ok(check, "nohz_full: " + list_text(cpus));
  }
  return warning(check,
                 (cpus.empty() ? "nohz_full is not set" : "nohz_full: " + list_text(cpus)) + "; expected " +
                     std::to_string(cpu) + ", or the tick interrupts the loop",
                 set_apart(files, cpu));
}

Finding callbacks(const MachineFiles& files, int cpu) {
  const std::string check = "RCU callbacks";
  if (!files.there("/proc/cmdline")) {
    return not_checked(check, absent("/proc/cmdline"));
  }
  const std::string asked = kernel_argument(files, "rcu_nocbs");
  const bool by_tick = contains(cpus_in(kernel_argument(files, "nohz_full")), cpu);  // which implies it
  if (by_tick || asked == "all" || contains(cpus_in(asked), cpu)) {
    return ok(check, "offloaded from " + cpu_text(cpu));
  }
  return warning(check,
                 (asked.empty() ? "rcu_nocbs is not set" : "rcu_nocbs: " + asked) + "; expected " +
                     std::to_string(cpu) + ", or the kernel tidies up in the loop's time",
                 set_apart(files, cpu));
}

Finding governor(const MachineFiles& files, const std::vector<int>& cpus) {
  const std::string check = "frequency governor";
  std::map<std::string, std::vector<int>> by_name;
  for (const int cpu : cpus) {
    const std::string path = std::string(kCpus) + "/cpu" + std::to_string(cpu) + "/cpufreq/scaling_governor";
    if (const std::optional<std::string> name = files.text(path)) {
      by_name[*name].push_back(cpu);
    }
  }
  if (by_name.empty()) {
    return not_checked(check, absent("/sys/devices/system/cpu/cpu*/cpufreq/scaling_governor") +
                                  ": the kernel does not set the frequency");
  }
  std::string found;
  for (const auto& [name, which] : by_name) {
    found += (found.empty() ? "" : ", ") + name + " (CPU " + list_text(which) + ")";
  }
  if (by_name.size() == 1 && by_name.contains("performance")) {
    return ok(check, found);
  }
  return warning(check, found + "; expected performance",
                 "`cpupower -c " + list_text(cpus) +
                     " frequency-set -g performance` (apt install linux-cpupower); to keep it, GOVERNOR=performance in "
                     "/etc/default/cpufrequtils (apt install cpufrequtils)");
}

}  // namespace

Group processor_checks(const MachineFiles& files, const LoopCpu& loop) {
  const std::optional<int> cpu = loop.examined;
  Group group{"Processor", {}};
  const std::vector<int> all = online(files);
  std::vector<Finding>& findings = group.findings;
  if (all.empty()) {
    findings.push_back(not_checked("loop's CPU", absent(std::string(kCpus) + "/online")));
  } else if (cpu) {
    findings.push_back(there(all, *cpu, loop));
  }
  if (all.size() == 1) {
    findings.push_back(not_checked("isolation", "there is one CPU: none can be set apart for the loop"));
  } else if (cpu && (all.empty() || contains(all, *cpu))) {
    findings.push_back(isolated(files, *cpu, loop.robot_file));
    findings.push_back(tickless(files, *cpu));
    findings.push_back(callbacks(files, *cpu));
    findings.push_back(interrupts(files, all, *cpu));
  } else if (!cpu && !all.empty()) {
    findings.push_back(unbound(files, all, loop.robot_file));
  }
  const std::vector<int> looked_at = cpu ? std::vector<int>{*cpu} : all;
  findings.push_back(governor(files, looked_at));
  findings.push_back(idle_states(files, looked_at));
  return group;
}

}  // namespace ivo::firmware::doctor
