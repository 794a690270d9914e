// One row of the fault table, tried: provoked at speed, and what came of it.
#pragma once

#include <optional>
#include <string>

#include "config/base/result.hpp"
#include "firmware/tools/bench/can/fault_row.hpp"

namespace ivo::firmware::bench {

/// Times are simulated.
struct FaultFigures {
  std::string says;                   ///< why it stopped, as a person reads it
  std::optional<double> detected_ms;  ///< from the provocation to the fault being latched
  std::optional<int> told_cycles;  ///< from then to the cycle since when every command stops all four, or none goes out
  std::optional<double> rest_ms;   ///< from the provocation to all four wheels at rest
  double rest_limit_ms = 0.0;      ///< what rest_ms may be: detection, then the quick stop's ramp from that speed
  int unasked = 0;  ///< frames that could move a wheel, and cycles with a wheel that turns, after the stop and before
                    ///< somebody agreed anew
  std::uint64_t frames_lost = 0;   ///< on the way in, as the operator sees them counted
  std::optional<double> ready_ms;  ///< from clearing to awaiting consent
  bool moves_again = false;        ///< or, where it goes on, has gone on
};

/// An error when the robot could not be brought so far that the fault could be provoked.
[[nodiscard]] Result<FaultFigures> try_fault(const FaultRow& row);

}  // namespace ivo::firmware::bench
