// `ivo run --console PATH`: the run as its console sees it, and what comes from there.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "firmware/console/console_desk.hpp"
#include "firmware/console/console_socket.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/tools/dialogue/dialogue.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_terminal.hpp"

namespace ivo::firmware {

class RunConsole {
 public:
  /// Before anything is written: none where none was asked for. Whoever connects waits until there is a RunConsole.
  [[nodiscard]] static Result<std::optional<console::Listener>> listen(const RunOptions& options);
  /// All outlive this; of the others as Dialogue has them.
  RunConsole(console::Listener listener, ControlLoop& loop, MissionInputs& inputs, planner::Planner& planner,
             const SearchObject& object);

  /// Before show(), with each status.
  [[nodiscard]] Dialogue& dialogue() noexcept { return *dialogue_; }
  /// `taken_up`: a search that somebody had set off in is taken up.
  void show(const LoopStatus& status, console::Asks asks, bool taken_up);
  struct Said {
    Answer answer = Answer::kNone;
    bool watched = false;  ///< of a yes: it counts only while beats come
  };
  /// What somebody has answered there, once.
  [[nodiscard]] Said answer_to(console::Asks asks);
  /// Ends it; how many messages came, and what became of them.
  [[nodiscard]] std::string close();

 private:
  int agents_;
  console::ConsoleDesk desk_;
  std::unique_ptr<Dialogue> dialogue_;
  console::ConsoleSocket socket_;
};

}  // namespace ivo::firmware
