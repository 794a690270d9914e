// `ivo run --console PATH`: the run as its console sees it, and what comes from there.
#pragma once

#include <optional>
#include <string>

#include "firmware/console/console_desk.hpp"
#include "firmware/console/console_socket.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_terminal.hpp"

namespace ivo::firmware {

class RunConsole {
 public:
  /// Before anything is written: none where none was asked for. Whoever connects waits until there is a RunConsole.
  [[nodiscard]] static Result<std::optional<console::Listener>> listen(const RunOptions& options);
  /// `loop` outlives this. `agents`: of the mission.
  RunConsole(console::Listener listener, ControlLoop& loop, int agents);

  /// `taken_up`: a search that somebody had set off in is taken up.
  void show(const LoopStatus& status, console::Asks asks, bool taken_up);
  /// What somebody has answered there, once.
  [[nodiscard]] Answer answer_to(console::Asks asks);
  /// Ends it; how many messages came, and what became of them.
  [[nodiscard]] std::string close();

 private:
  console::ConsoleDesk desk_;
  console::ConsoleSocket socket_;
  int agents_;
};

}  // namespace ivo::firmware
