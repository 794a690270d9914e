#include "firmware/tools/doctor/memory_checks.hpp"

#include <optional>
#include <string>

#include "firmware/tools/doctor/process_limits.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

std::string megabytes(std::uint64_t bytes) { return format("%.0f MiB", static_cast<double>(bytes) / (1U << 20U)); }

Finding lock_limit(const MachineFiles& files, std::uint64_t needed) {
  const std::string check = "memory lock limit";
  if (has_capability(kCapIpcLock, files)) {
    return ok(check, "none: CAP_IPC_LOCK; the controller needs up to " + megabytes(needed));
  }
  const std::optional<Limit> limit = limit_called("Max locked memory", files);
  if (!limit) {
    return not_checked(check, "/proc/self/limits does not tell it");
  }
  const std::string found = limit->unlimited ? "unlimited" : megabytes(limit->value);
  if (limit->allows(needed)) {
    return ok(check, found + "; the controller needs up to " + megabytes(needed));
  }
  return fault(
      check, found + "; expected at least " + megabytes(needed),
      "\"ivo - memlock unlimited\" in /etc/security/limits.d/ivo.conf (ivo: who runs it), then log in anew; of a "
      "service LimitMEMLOCK=infinity");
}

/// "MemAvailable:    123 kB"
std::optional<std::uint64_t> available(const MachineFiles& files) {
  for (const std::string& line : files.lines("/proc/meminfo")) {
    const std::vector<std::string> words = words_of(line);
    const std::optional<std::int64_t> kib = words.size() > 1 ? whole_number(words[1]) : std::nullopt;
    if (kib && *kib >= 0 && words[0] == "MemAvailable:") {
      return static_cast<std::uint64_t>(*kib) << 10U;
    }
  }
  return std::nullopt;
}

Finding room(const MachineFiles& files, std::uint64_t needed) {
  const std::string check = "free memory";
  const std::optional<std::uint64_t> bytes = available(files);
  if (!bytes) {
    return not_checked(check, "/proc/meminfo does not tell it");
  }
  const std::string found = megabytes(*bytes) + " available";
  return *bytes >= needed ? ok(check, found)
                          : fault(check, found + "; expected at least " + megabytes(needed),
                                  "end other programs (`ps aux --sort=-rss | head`), or a build with "
                                  "-DIVO_PLANNER_PROFILE=micro");
}

Finding swap(const MachineFiles& files) {
  const std::string check = "swap";
  const std::vector<std::string> lines = files.lines("/proc/swaps");
  if (lines.empty()) {
    return not_checked(check, absent("/proc/swaps"));
  }
  std::string devices;
  for (std::size_t i = 1; i < lines.size(); ++i) {  // after the heading
    const std::vector<std::string> words = words_of(lines[i]);
    if (!words.empty()) {
      devices += (devices.empty() ? "" : ", ") + words[0];
    }
  }
  return devices.empty() ? ok(check, "none")
                         : warning(check, "on " + devices + ": what is not locked may wait for the disk",
                                   "`swapoff -a`; to keep it so, its line out of /etc/fstab");
}

}  // namespace

Group memory_checks(const MachineFiles& files, std::uint64_t needed) {
  return {"Memory", {lock_limit(files, needed), room(files, needed), swap(files)}};
}

}  // namespace ivo::firmware::doctor
