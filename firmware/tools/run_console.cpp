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

namespace {

console::BoardRules rules_of(const MissionInputs& inputs) {
  const planner::SegmentedMap map = inputs.map.view();
  return {static_cast<int>(inputs.file.mission.agents.size()), map.width_m(), map.height_m()};
}

console::Reported reported_of(const Mission& mission) {
  console::Reported reported{};
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    const AgentSpec& agent = mission.agents[m];
    reported[m] = agent.kind == AgentKind::kPerson && agent.motion == PersonMotion::kReported;
  }
  return reported;
}

}  // namespace

RunConsole::RunConsole(console::Listener listener, ControlLoop& loop, MissionInputs& inputs, planner::Planner& planner,
                       const SearchObject& object)
    : agents_(static_cast<int>(inputs.file.mission.agents.size())),
      desk_(rules_of(inputs), reported_of(inputs.file.mission),
            {[&loop] { loop.request_stop(); }, [&loop] { loop.request_pause(); }, [&loop] { loop.beat(); }}),
      dialogue_(std::make_unique<Dialogue>(inputs, planner, object, loop, desk_)),
      socket_(std::move(listener), desk_) {}

void RunConsole::show(const LoopStatus& status, console::Asks asks, bool taken_up) {
  if (status.counters.cycles == 0) {
    return;  // the loop has said nothing yet
  }
  console::Status shown = console::status_of(status, agents_);
  shown.taken_up = taken_up && !status.consented ? 1 : 0;
  dialogue_->complete(shown);
  desk_.show(shown, asks);
}

RunConsole::Said RunConsole::answer_to(console::Asks asks) {
  const std::optional<console::DeskAnswer> answer = desk_.take(asks);
  if (!answer) {
    return {};
  }
  return {answer->kind == console::Kind::kNoConsent ? Answer::kNo : Answer::kYes, answer->watched};
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
