// How much room and how much patience does the disk ask for?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "config/base/time.hpp"

namespace ivo::firmware::doctor {

struct DiskFacts {
  std::string folder;            ///< where it was tried: the one asked for, or the nearest above it that is there
  std::uint64_t free_bytes = 0;  ///< for this user
  bool in_memory = false;        ///< lost when the power goes
  std::vector<Duration> writes;  ///< a block written and synced, sorted
  std::string refusal;           ///< why nothing could be written there; empty: it could
};

/// Writes and syncs a few blocks in a file without a name, of which nothing stays; about half a second at most. Refuses
/// a `folder` that is a file, or lies below one.
[[nodiscard]] Result<DiskFacts> try_disk(const std::string& folder);

}  // namespace ivo::firmware::doctor
