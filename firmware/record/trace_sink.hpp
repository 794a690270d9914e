// Where trace events end up.
#pragma once

#include <cstdint>
#include <string>

#include "config/base/result.hpp"
#include "firmware/record/trace_event.hpp"

namespace ivo::firmware {

/// Outside the loop: every call may wait for a disk. Events come in the order in which they were written.
class TraceSink {
 public:
  virtual ~TraceSink() = default;
  virtual void take(const TraceEvent& event) = 0;
  /// All that was taken is handed to the system.
  virtual void write_out() = 0;
  /// `lost`: events that did not get here. Fails when something is missing, and says what. The last call.
  [[nodiscard]] virtual Result<void> close(std::uint64_t lost) = 0;
  /// "4711 events in FILE"
  [[nodiscard]] virtual std::string summary() const = 0;
};

}  // namespace ivo::firmware
