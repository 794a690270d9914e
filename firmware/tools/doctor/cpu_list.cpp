#include "firmware/tools/doctor/cpu_list.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <sstream>

#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::int64_t kLastCpu = 8191;

}  // namespace

std::vector<int> cpus_in(const std::string& list) {
  std::vector<int> cpus;
  std::istringstream parts(list);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t dash = part.find('-');
    const std::optional<std::int64_t> first = whole_number(part.substr(0, dash));
    const std::optional<std::int64_t> last = dash == std::string::npos ? first : whole_number(part.substr(dash + 1));
    if (!first || !last || *first < 0 || *last > kLastCpu) {
      continue;
    }
    for (std::int64_t cpu = *first; cpu <= *last; ++cpu) {
      cpus.push_back(static_cast<int>(cpu));
    }
  }
  std::ranges::sort(cpus);
  cpus.erase(std::unique(cpus.begin(), cpus.end()), cpus.end());
  return cpus;
}

bool contains(const std::vector<int>& cpus, int cpu) { return std::ranges::binary_search(cpus, cpu); }

std::string list_text(const std::vector<int>& cpus) {
  std::string text;
  for (std::size_t i = 0; i < cpus.size();) {
    std::size_t last = i;
    while (last + 1 < cpus.size() && cpus[last + 1] == cpus[last] + 1) {
      ++last;
    }
    text += (text.empty() ? "" : ",") + std::to_string(cpus[i]);
    if (last > i) {
      text += "-" + std::to_string(cpus[last]);
    }
    i = last + 1;
  }
  return text;
}

std::vector<int> without(const std::vector<int>& all, int cpu) {
  std::vector<int> rest;
  std::ranges::copy_if(all, std::back_inserter(rest), [cpu](int one) { return one != cpu; });
  return rest;
}

}  // namespace ivo::firmware::doctor
