#include "firmware/tools/run_console.hpp"

#include <utility>

#include "firmware/console/console_status.hpp"
#include "firmware/console/verdict_text.hpp"

namespace ivo::firmware {

Result<std::optional<console::Listener>> RunConsole::listen(const RunOptions& options) {
  if (options.console.empty()) {
    return std::optional<console::Listener>();
  }
  Result<console::Listener> listener = console::Listener::at(options.console);
  if (!listener) {
    return Error{"--console: " + listener.error().message};
  }
  return std::optional(std::move(listener).value());
}

RunConsole::RunConsole(console::Listener listener, ControlLoop& loop, int agents)
    : desk_([&loop] { loop.request_stop(); }), socket_(std::move(listener), desk_), agents_(agents) {}

void RunConsole::show(const LoopStatus& status, console::Asks asks, bool taken_up) {
  console::Status shown = console::status_of(status, agents_);
  shown.taken_up = taken_up && !status.consented ? 1 : 0;
  desk_.show(shown, asks);
}

Answer RunConsole::answer_to(console::Asks asks) {
  const std::optional<console::Kind> answer = desk_.take(asks);
  if (!answer) {
    return Answer::kNone;
  }
  return *answer == console::Kind::kNoConsent ? Answer::kNo : Answer::kYes;
}

std::string RunConsole::close() {
  socket_.close();
  const auto& messages = socket_.counters().messages;
  std::string text;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (messages[i] > 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(messages[i]) + " " +
              std::string(name_of(static_cast<console::Verdict>(i)));
    }
  }
  const bool failed = socket_.counters().ended_early > 0;
  return "messages: " + (text.empty() ? "none" : text) + (failed ? "; it failed, and served nobody from then on" : "");
}

}  // namespace ivo::firmware
