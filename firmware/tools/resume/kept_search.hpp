// What is kept of a search while it goes on, so that another process can take it up: as plain values, and as the bytes
// of a StateFile.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/time.hpp"
#include "firmware/mission/resumed_search.hpp"

namespace ivo::firmware {

/// A file that the search was made of, and what was in it.
struct KeptSource {
  std::string path;
  std::uint64_t fingerprint = 0;
  friend bool operator==(const KeptSource&, const KeptSource&) = default;
};

struct KeptSearch {
  /// Of the bytes. What planner and prior make of the sources is made of them again, not kept: a belief that a search
  /// changes on its way will be a new version.
  static constexpr std::uint32_t kVersion = 3;

  std::string world;  ///< search_world(): where the drives were
  std::vector<KeptSource> sources;
  bool ended = false;            ///< and reported: nothing is left to go on with
  std::int64_t unix_time_s = 0;  ///< when it was kept, of this machine's calendar
  double at_s = 0.0;             ///< when it was kept, as the event log tells time
  std::uint64_t log_bytes = 0;   ///< of the event log, which tells of all that is in here
  bool planned = false;          ///< `search` holds a plan
  bool consented = false;        ///< somebody has agreed to it
  ResumedSearch search;
};

[[nodiscard]] std::string to_bytes(const KeptSearch& kept);
/// All of `kept` is read; false when they are no whole KeptSearch of this version, or hold more than this build has
/// room for.
[[nodiscard]] bool from_bytes(std::string_view bytes, KeptSearch& kept);

}  // namespace ivo::firmware
