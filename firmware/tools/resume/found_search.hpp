// What an earlier run left of a search in a folder.
#pragma once

#include <memory>
#include <string>

#include "config/base/result.hpp"
#include "firmware/record/state_file.hpp"
#include "firmware/tools/resume/kept_search.hpp"

namespace ivo::firmware {

struct FoundSearch {
  FoundState state;                                                   ///< the slots
  bool there = false;                                                 ///< something was kept
  std::unique_ptr<KeptSearch> kept = std::make_unique<KeptSearch>();  ///< when there is no `fault`; it is large
  std::string fault;  ///< one line: why it cannot be taken up, whoever wants to

  /// There is a search that was not brought to its end and report, or something of which nobody knows.
  [[nodiscard]] bool unfinished() const noexcept { return there && (!fault.empty() || !kept->ended); }
};

/// Fails when the state cannot be read at all.
[[nodiscard]] Result<FoundSearch> look_for_search(const std::string& state_path);

/// "12 s ago", "3 min ago", "5 h ago", "2 days ago".
[[nodiscard]] std::string age_text(std::int64_t seconds);

}  // namespace ivo::firmware
