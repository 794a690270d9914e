// What an event log tells of a run that was cut off: the tracks, and the steps of the search.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"

namespace ivo::firmware {

struct LoggedStep {
  enum class Kind : std::uint8_t { kSetOff, kPosition, kFound, kPathsEnded };
  Kind kind = Kind::kPosition;
  double t_s = 0.0;
  std::size_t agent = 0;
  Point at;
};

struct LoggedRun {
  std::vector<std::vector<Point>> tracks;  ///< an agent each, as EventLog::tracks
  std::vector<LoggedStep> steps;
  double last_s = 0.0;            ///< time of the last line
  std::uint64_t whole_bytes = 0;  ///< to the end of the last whole line; behind it is a torn one
  int unreadable = 0;             ///< lines that are no event
};

/// Reads the log at `path` of a run of `agents` (names by number). Fails when it cannot be read.
[[nodiscard]] Result<LoggedRun> read_logged_run(const std::string& path, const std::vector<std::string>& agents);

}  // namespace ivo::firmware
