// The command line of `ivo`: one sub-command a file.
#pragma once

namespace ivo::firmware {

/// Runs what was asked; returns the exit status. 2 for a command line that makes no sense.
[[nodiscard]] int command_line(int argc, const char* const* argv);

}  // namespace ivo::firmware
