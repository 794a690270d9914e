#include "firmware/tools/doctor/interrupt_check.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "firmware/tools/doctor/cpu_list.hpp"
#include "firmware/tools/doctor/kernel_command_line.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::size_t kNamed = 3;  // the rest is counted

/// Who handles it: the one name in the folder that is not the kernel's own.
std::string handler(const MachineFiles& files, const std::string& folder) {
  constexpr std::array<std::string_view, 7> kOwn{"affinity_hint", "effective_affinity", "effective_affinity_list",
                                                 "node",          "smp_affinity",       "smp_affinity_list",
                                                 "spurious"};
  for (const std::string& name : files.names(folder)) {
    if (std::ranges::find(kOwn, name) == kOwn.end()) {
      return name;
    }
  }
  return {};
}

std::string where(const MachineFiles& files, const std::string& folder) {
  return files.text(folder + "/effective_affinity_list")
      .value_or(files.text(folder + "/smp_affinity_list").value_or(""));
}

}  // namespace

Finding interrupts(const MachineFiles& files, const std::vector<int>& all, int cpu) {
  const std::string check = "interrupts";
  if (!files.there("/proc/irq")) {
    return not_checked(check, absent("/proc/irq"));
  }
  std::vector<std::string> here;
  int handled = 0;
  for (const std::string& number : files.names("/proc/irq")) {
    const std::string folder = "/proc/irq/" + number;
    const std::string name = handler(files, folder);
    if (name.empty() || !whole_number(number)) {
      continue;
    }
    ++handled;
    if (contains(cpus_in(where(files, folder)), cpu)) {
      here.push_back(format("%s (%s)", number.c_str(), name.c_str()));
    }
  }
  if (here.empty()) {
    return ok(check, format("none of %d on CPU %d", handled, cpu));
  }
  std::string found = format("%d of %d on CPU %d: ", static_cast<int>(here.size()), handled, cpu);
  for (std::size_t i = 0; i < std::min(kNamed, here.size()); ++i) {
    found += (i == 0 ? "" : ", ") + here[i];
  }
  const std::string others = list_text(without(all, cpu));
  return warning(check, found + (here.size() > kNamed ? ", ..." : ""),
                 "`echo " + others + " >/proc/irq/NUMBER/smp_affinity_list`; at each boot: " +
                     add_to_command_line(files, "irqaffinity=" + others));
}

}  // namespace ivo::firmware::doctor
