// Ctrl-C and its relatives as a question, for commands that move nothing.
#pragma once

namespace ivo::firmware {

/// From now on SIGINT, SIGTERM and SIGHUP end the program at once, with the exit status of a stop: while there is
/// nothing that would be lost. `line` is said then, with its line break; it lasts as long as the program.
void end_on_signals(const char* line);

/// From now on SIGINT, SIGTERM and SIGHUP only set what stop_asked() answers, and a reader of our output that goes away
/// ends nothing.
void stop_on_signals();
/// SIGQUIT and SIGTSTP too: every key with which a person in a hurry ends or suspends a program.
void stop_on_all_signals();
[[nodiscard]] bool stop_asked() noexcept;

}  // namespace ivo::firmware
