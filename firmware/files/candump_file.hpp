// Reads a record of frames as `candump -L` and `ivo run --record` write it, line by line: it may be longer than memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::firmware {

struct CandumpContents {
  std::string interface;        ///< of the first line; empty without one
  std::uint64_t frames = 0;     ///< data frames with an 11-bit identifier on that interface
  std::uint64_t others = 0;     ///< 29-bit identifiers, remote, error and FD frames
  std::uint64_t elsewhere = 0;  ///< of other interfaces: another bus
};

/// Gives each of CandumpContents::frames to `each`, with its time since 1970 as the file has it. Refuses a line that is
/// none of a record, by its number.
[[nodiscard]] Result<CandumpContents> read_candump(const std::string& path,
                                                   const std::function<void(Instant, const hal::CanFrame&)>& each);

}  // namespace ivo::firmware
