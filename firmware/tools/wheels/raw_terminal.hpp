// The terminal as keys: each arrives when it is pressed, and none is shown.
#pragma once

#include <string>

namespace ivo::firmware::wheels {

/// Until it ends: no line editing, no echo, no keys that signal or stop the output. What the terminal was before is put
/// back then, and also when the program is brought down by a fault of its own; only SIGKILL leaves it as it is (`reset`
/// mends it). One at a time.
class RawTerminal {
 public:
  /// Standard input and output are terminals.
  [[nodiscard]] static bool possible();

  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  /// Keys that have come, after up to `wait_ms`; a signal ends the wait.
  [[nodiscard]] std::string keys(int wait_ms);
  /// It went away: nobody can press a key any more.
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  /// Keys that came before now were not meant for what is asked now.
  void forget_keys();

 private:
  bool closed_ = false;
};

}  // namespace ivo::firmware::wheels
