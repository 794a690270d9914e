// A machine of a test's own: a folder with the files that its kernel would show.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/machine_files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ivo::firmware::doctor {

inline constexpr std::uint64_t kMiB = std::uint64_t{1} << 20U;

class MachineFolder {
 public:
  /// Begins with what is usually there, a file each: {path, contents}.
  MachineFolder(std::initializer_list<std::pair<std::string_view, std::string_view>> contents = {}) {
    for (const auto& [path, text] : contents) {
      put(path, text);
    }
  }

  void put(std::string_view path, std::string_view contents) {
    const std::string whole = folder_.path() + std::string(path);
    std::filesystem::create_directories(std::filesystem::path(whole).parent_path());
    std::ofstream(whole, std::ios::binary) << contents;
  }
  void remove(std::string_view path) { std::filesystem::remove_all(folder_.path() + std::string(path)); }

  [[nodiscard]] MachineFiles files() const { return MachineFiles(folder_.path()); }

 private:
  ScratchFolder folder_;
};

/// The finding of that name; a failure, and an empty one, where there is none.
inline Finding of(const Group& group, std::string_view check) {
  const auto found = std::ranges::find(group.findings, check, &Finding::check);
  if (found == group.findings.end()) {
    ADD_FAILURE() << group.name << " says nothing of " << check;
    return {};
  }
  return *found;
}

/// Whoever reads a finding that is not well knows what to do, and nobody is sent to mend what is well.
inline void expect_remedies(const Group& group) {
  for (const Finding& finding : group.findings) {
    const bool wrong = finding.state == State::kWarning || finding.state == State::kFault;
    EXPECT_EQ(wrong, !finding.remedy.empty()) << finding.check << ": " << finding.found;
    EXPECT_FALSE(finding.found.empty()) << finding.check;
    EXPECT_EQ((finding.found + finding.remedy).find('\n'), std::string::npos) << finding.check;
  }
}

}  // namespace ivo::firmware::doctor
