#include "firmware/tools/doctor/process_limits.hpp"

#include <charconv>
#include <vector>

namespace ivo::firmware::doctor {

std::optional<Limit> limit_called(const std::string& name, const MachineFiles& files) {
  for (const std::string& line : files.lines("/proc/self/limits")) {
    if (!line.starts_with(name)) {
      continue;
    }
    const std::vector<std::string> values = words_of(line.substr(name.size()));
    if (values.empty()) {
      return std::nullopt;
    }
    const std::optional<std::int64_t> soft = whole_number(values.front());
    return Limit{values.front() == "unlimited", static_cast<std::uint64_t>(soft.value_or(0))};
  }
  return std::nullopt;
}

bool has_capability(unsigned number, const MachineFiles& files) {
  for (const std::string& line : files.lines("/proc/self/status")) {
    const std::vector<std::string> words = words_of(line);
    if (words.size() == 2 && words[0] == "CapEff:") {
      std::uint64_t effective = 0;
      (void)std::from_chars(words[1].data(), words[1].data() + words[1].size(), effective, 16);
      return (effective >> number & 1U) != 0;
    }
  }
  return false;
}

}  // namespace ivo::firmware::doctor
