// Commands that nobody can follow, at the two doors in front of the real bus: no loop makes them, so they are put there
// by hand.
#pragma once

#include "firmware/tools/bench/can/fault_trial.hpp"

namespace ivo::firmware::bench {

enum class WrongCommand : std::uint8_t {
  kNotANumber,
  kInfinite,
  kHuge,
  kHugePastTheGate,  ///< straight to the wheels: the second door is left
};

/// Four drives at 0.3 m/s, then half a second of `wrong`, then a sane command.
[[nodiscard]] Result<FaultFigures> try_command(WrongCommand wrong);

}  // namespace ivo::firmware::bench
