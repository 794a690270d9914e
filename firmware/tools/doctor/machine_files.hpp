// The files in which Linux tells about a machine: /proc, /sys, /etc.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ivo::firmware::doctor {

/// Reads below a root folder: "/" on a machine, another in tests. A file that is not there, or may not be read, is an
/// answer like any other: containers and other kernels lack many. Paths begin with a slash.
class MachineFiles {
 public:
  explicit MachineFiles(std::string root = "/") : root_(std::move(root)) {}

  /// The whole text without white space at its ends; at most 1 MiB of it.
  [[nodiscard]] std::optional<std::string> text(const std::string& path) const;
  /// As it is.
  [[nodiscard]] std::optional<std::string> bytes(const std::string& path) const;
  [[nodiscard]] std::optional<std::int64_t> number(const std::string& path) const;
  /// Empty where there is none.
  [[nodiscard]] std::vector<std::string> lines(const std::string& path) const;
  /// Names in a folder, sorted; empty where there is none.
  [[nodiscard]] std::vector<std::string> names(const std::string& folder) const;
  [[nodiscard]] bool there(const std::string& path) const;

 private:
  std::string root_;
};

/// "/sys/kernel/realtime is not there"
[[nodiscard]] std::string absent(const std::string& path);

/// A whole number and nothing else.
[[nodiscard]] std::optional<std::int64_t> whole_number(const std::string& text);

/// What stands between white space.
[[nodiscard]] std::vector<std::string> words_of(const std::string& line);

}  // namespace ivo::firmware::doctor
