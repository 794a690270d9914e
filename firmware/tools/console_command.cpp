#include "firmware/tools/console_command.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "config/base/time.hpp"
#include "firmware/console/console_client.hpp"
#include "firmware/console/verdict_text.hpp"
#include "firmware/loop/loop_status.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

using console::Asks;
using console::Kind;
using console::Status;
using console::Verdict;

// What another program sent is no index yet.
std::string mode_text(const Status& status) {
  return status.mode < kModes ? std::string(name_of(static_cast<Mode>(status.mode))) : "unknown";
}

std::string asks_text(const Status& status) {
  switch (status.asks) {
    case Asks::kConsent:
      return "; asks for consent: the robot will move";
    case Asks::kClearing:
      return "; asks whether to start the drives up again";
    case Asks::kNothing:
      break;
  }
  return {};
}

// What a person at the controller's terminal is told before the question.
void warn_of_pose(const Status& status) {
  if (status.taken_up != 0) {
    say("taken up", "the robot is taken to stand at " + place_text({status.agent[0].x_m, status.agent[0].y_m}) +
                        "; see to it before you agree");
  }
}

std::string messages_text(const Status& status) {
  std::string text = format("%llu accepted", static_cast<unsigned long long>(status.messages[0]));
  for (std::size_t i = 1; i < status.messages.size(); ++i) {
    if (status.messages[i] > 0) {
      text += format(", %llu ", static_cast<unsigned long long>(status.messages[i])) +
              std::string(name_of(static_cast<Verdict>(i)));
    }
  }
  return text + format("; %llu answers and %llu statuses not read in time",
                       static_cast<unsigned long long>(status.answers_dropped),
                       static_cast<unsigned long long>(status.statuses_dropped));
}

void show(const Status& status) {
  say("mode", mode_text(status) + asks_text(status));
  warn_of_pose(status);
  if (const auto end = std::ranges::find(status.fault, '\0'); end != status.fault.begin()) {
    say("fault", std::string(status.fault.begin(), end));
  }
  say("planner", format("generation %d of %d", status.generation, status.generations) +
                     (status.horizon_s > 0 ? format(", expected time %.1f s, %.2f %% unseen", status.expected_time_s,
                                                    100 * status.unseen_mass)
                                           : std::string()));
  if (status.search_started != 0) {
    say("search", format("%.1f s", seconds(Duration(status.search_time_ns))));
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(status.agents, status.agent.size()); ++i) {
    const console::AgentStatus& agent = status.agent[i];
    say(i == 0 ? "agents" : "", place_text({agent.x_m, agent.y_m}) + format(", %.1f m gone", agent.moved_m) +
                                    (agent.path_ended != 0 ? ", at the end of its path" : ""));
  }
  say("loop", format("%llu cycles, %llu periods skipped, %llu frames sent, %llu received, %llu not sent, %llu lost",
                     static_cast<unsigned long long>(status.cycles), static_cast<unsigned long long>(status.skipped),
                     static_cast<unsigned long long>(status.frames_sent),
                     static_cast<unsigned long long>(status.frames_received),
                     static_cast<unsigned long long>(status.send_dropped),
                     static_cast<unsigned long long>(status.receive_dropped)));
  say("console", format("%u connected; messages: ", status.clients) + messages_text(status));
}

// In the order of ConsoleVerb.
constexpr std::array kKindOfVerb{Kind::kPing, Kind::kConsent, Kind::kNoConsent, Kind::kStop, Kind::kClearFault};

}  // namespace

int console_command(const ConsoleOptions& options) {
  Result<console::ConsoleClient> connected = console::ConsoleClient::connect(options.socket);
  if (!connected) {
    return refuse(connected.error());
  }
  console::ConsoleClient& client = connected.value();
  const Result<Status> status = client.status();
  if (!status) {
    return refuse(status.error());
  }
  if (options.verb == ConsoleVerb::kStatus) {
    show(status.value());
    return exit_status::kEnded;
  }
  if (options.verb == ConsoleVerb::kConsent) {
    warn_of_pose(status.value());
  }
  const Result<Verdict> verdict =
      client.command(kKindOfVerb[static_cast<std::size_t>(options.verb)], status.value().question);
  if (!verdict) {
    return refuse(verdict.error());
  }
  if (verdict.value() != Verdict::kAccepted) {
    complain({"the controller refuses: " + std::string(name_of(verdict.value())) + "; it is " +
              mode_text(status.value()) + asks_text(status.value())});
    return exit_status::kFaultOrStop;
  }
  say("console", "accepted");
  return exit_status::kEnded;
}

}  // namespace ivo::firmware
