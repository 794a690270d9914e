// How the programs that run on every CPU start, speak and end: with an operating system, or by semihosting on the bare
// CPU.
#pragma once

#include <string_view>

namespace ivo::cross {

/// The program; each of them defines it. Its value is the exit status.
[[nodiscard]] int run() noexcept;

/// As it is, without buffering beyond the program's end.
void print(std::string_view text) noexcept;

/// A clock that instructions drive, in its own ticks; wraps at 2^32. Only the bare CPU has one.
[[nodiscard]] unsigned instruction_clock() noexcept;
struct InstructionsPerTick {
  unsigned instructions;
  unsigned ticks;
};
[[nodiscard]] InstructionsPerTick instructions_per_tick() noexcept;

}  // namespace ivo::cross
