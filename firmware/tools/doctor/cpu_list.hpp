// Lists of CPUs as the kernel writes them: "0-3,5".
#pragma once

#include <string>
#include <vector>

namespace ivo::firmware::doctor {

/// Sorted, each once. Of words that are no numbers ("domain", "managed_irq" of isolcpus=) and of broken parts nothing;
/// no number beyond 8191, the most that a kernel counts.
[[nodiscard]] std::vector<int> cpus_in(const std::string& list);
[[nodiscard]] bool contains(const std::vector<int>& cpus, int cpu);
/// "0-3,5"
[[nodiscard]] std::string list_text(const std::vector<int>& cpus);
/// Those of `all` but `cpu`.
[[nodiscard]] std::vector<int> without(const std::vector<int>& all, int cpu);

}  // namespace ivo::firmware::doctor
