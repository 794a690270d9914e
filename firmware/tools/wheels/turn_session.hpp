// What turn and check have in common: the questions before anything turns, the live line, the end.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/raw_terminal.hpp"
#include "firmware/tools/wheels/turn_loop.hpp"
#include "firmware/tools/wheels/wheels_world.hpp"

namespace ivo::firmware::wheels {

class TurnSession {
 public:
  static constexpr int kWaitMs = 20;

  /// Everything that must be so before the drives are started: a terminal, a world, no controller, no fault, a base on
  /// blocks. Says what it does; none with the exit status in `status` when it is not to be.
  [[nodiscard]] static std::unique_ptr<TurnSession> begin(const Options& options, const char* command, int& status);

  [[nodiscard]] World& world() noexcept { return *world_; }
  [[nodiscard]] TurnLoop& loop() noexcept { return *loop_; }
  [[nodiscard]] RawTerminal& terminal() noexcept { return *terminal_; }
  [[nodiscard]] LiveLine& line() noexcept { return line_; }

  /// Draws what is going on, and says a note once.
  void show(const TurnStatus& status);
  /// Asks and waits for one of `keys`, which is shown; none when it is to end (Ctrl-C, escape, a signal, a terminal
  /// that went away, a loop that ended).
  [[nodiscard]] std::optional<char> ask(const std::string& question, const std::string& keys);
  /// Asks for a number above 0, or 'a'; Enter is `usual`. None when it is to end, 0 for 'a'.
  [[nodiscard]] std::optional<double> ask_number(const std::string& question, double usual);
  /// Power off; says so, or that it is not known. Returns the exit status for how it ended.
  [[nodiscard]] int finish();
  [[nodiscard]] bool over() noexcept;

 private:
  TurnSession() = default;

  std::unique_ptr<World> world_;
  std::unique_ptr<RawTerminal> terminal_;
  std::unique_ptr<TurnLoop> loop_;
  LiveLine line_;
  TurnNote noted_ = TurnNote::kNone;
};

}  // namespace ivo::firmware::wheels
