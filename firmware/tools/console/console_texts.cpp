#include "firmware/tools/console/console_texts.hpp"

#include <algorithm>
#include <cstddef>

#include "config/base/time.hpp"
#include "firmware/console/verdict_text.hpp"
#include "firmware/loop/loop_status.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {

using console::Asks;
using console::Status;
using console::Verdict;

namespace {

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

std::string pause_text(const Status& status) {
  switch (static_cast<PauseCause>(status.pause_cause)) {
    case PauseCause::kBeatLost:
      return "the operator's page was not heard";
    case PauseCause::kReplan:
      return "a plan is made anew";
    case PauseCause::kNoGo:
      return "a no-go area lies ahead";
    case PauseCause::kNone:
    case PauseCause::kAsked:
      break;
  }
  return "somebody asked for it";
}

double number_in(const Json& object, std::string_view name) {
  const Json* const member = object.member(name);
  return member != nullptr && member->is_number() ? member->real : 0.0;
}

std::string figure(const Json& object, std::string_view name, const char* form, double scale = 1.0) {
  const Json* const member = object.member(name);
  return member != nullptr && member->is_number() ? format(form, scale * member->real) : "-";
}

const Json& part(const Json& object, std::string_view name) {
  static const Json kNone;
  const Json* const member = object.member(name);
  return member != nullptr ? *member : kNone;
}

// A line of the table: the plan, and the one before it.
void compare(const char* label, const std::string& now, const std::string& before, bool has_before) {
  say(label, format("%-14s", now.c_str()) + (has_before ? "before: " + before : ""));
}

std::string name_of_agent(const std::vector<std::string>& names, std::size_t agent) {
  return agent < names.size() ? names[agent] : "agent " + std::to_string(agent);
}

}  // namespace

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

void show_status(const Status& status, const std::vector<std::string>& names) {
  say("mode", mode_text(status) + asks_text(status));
  warn_of_pose(status);
  if (const auto end = std::ranges::find(status.fault, '\0'); end != status.fault.begin()) {
    say("fault", std::string(status.fault.begin(), end));
  }
  if (status.pause_cause != 0 && status.search_started != 0 &&
      status.mode != static_cast<std::uint8_t>(Mode::kSearching)) {
    say("paused", pause_text(status));
  }
  say("planner", format("generation %d of %d", status.generation, status.generations) +
                     (status.horizon_s > 0 ? format(", expected time %.1f s, %.2f %% unseen", status.expected_time_s,
                                                    100 * status.unseen_mass)
                                           : std::string()));
  if (status.search_started != 0) {
    say("search", format("%.1f s, %.0f %% of the probability searched", seconds(Duration(status.search_time_ns)),
                         100 * status.searched_mass));
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(status.agents, status.agent.size()); ++i) {
    const console::AgentStatus& agent = status.agent[i];
    say(i == 0 ? "agents" : "", (i < names.size() ? names[i] + " " : std::string()) +
                                    place_text({agent.x_m, agent.y_m}) + format(", %.1f m gone", agent.moved_m) +
                                    (agent.path_ended != 0 ? ", at the end of its path" : ""));
  }
  say("plan", "number " + std::to_string(status.plan_number) +
                  (status.with_preferences != 0 ? ", with preferred areas" : ", without preferred areas") +
                  (status.preparing != 0    ? "; another is being made ready"
                   : status.accepted != 0   ? "; accepted"
                   : status.plan_ready != 0 ? "; not accepted"
                                            : "; not ready"));
  if (status.into_no_go < names.size()) {
    say("", "leads " + names[status.into_no_go] + " into a no-go area that was drawn later; expected another plan");
  }
  say("loop", format("%llu cycles, %llu periods skipped, %llu frames sent, %llu received, %llu not sent, %llu lost",
                     static_cast<unsigned long long>(status.cycles), static_cast<unsigned long long>(status.skipped),
                     static_cast<unsigned long long>(status.frames_sent),
                     static_cast<unsigned long long>(status.frames_received),
                     static_cast<unsigned long long>(status.send_dropped),
                     static_cast<unsigned long long>(status.receive_dropped)));
  say("console", format("%u connected; messages: ", status.clients) + messages_text(status));
}

void show_plans(const Json& plan, const Json& previous, const std::vector<std::string>& names) {
  if (plan.kind != Json::Kind::kObject) {
    say("plan", "none yet");
    return;
  }
  const bool has_before = previous.kind == Json::Kind::kObject;
  const Json& now = part(plan, "score");
  const Json& before = part(previous, "score");
  compare("ET", figure(now, "expected_time_s", "%.1f s"), figure(before, "expected_time_s", "%.1f s"), has_before);
  compare("as preferred", figure(now, "expected_sub_prior_time_s", "%.1f s"),
          figure(before, "expected_sub_prior_time_s", "%.1f s"), has_before);
  compare("above bound", figure(plan, "gap", "%.0f %%", 100), figure(previous, "gap", "%.0f %%", 100), has_before);
  compare("unseen", figure(now, "unseen_mass", "%.1f %%", 100), figure(before, "unseen_mass", "%.1f %%", 100),
          has_before);
  const auto& agents = part(plan, "agents").elements;
  const auto& agents_before = part(previous, "agents").elements;
  for (std::size_t m = 0; m < agents.size(); ++m) {
    const auto text = [](const Json& agent) {
      return figure(agent, "length_m", "%.1f m") + ", " + figure(agent, "preferred_share", "%.0f %% preferred", 100);
    };
    say(name_of_agent(names, m).c_str(),
        text(agents[m]) + (m < agents_before.size() ? "; before: " + text(agents_before[m]) : ""));
  }
}

void show_areas(const Json& areas, const std::vector<std::string>& names) {
  const auto& list = part(areas, "areas").elements;
  if (list.empty()) {
    say("areas", "none");
  }
  for (const Json& area : list) {
    const bool no_go = part(area, "purpose").text == "no_go";
    const Json& agent = part(area, "agent");
    const std::string who =
        agent.is_number() ? name_of_agent(names, static_cast<std::size_t>(agent.count)) : std::string("everybody");
    say(format("area %.0f", number_in(area, "slot")).c_str(),
        (no_go ? "no-go for " : "preferred by ") + who +
            format(", %.1f m2, %.1f %% of the probability", number_in(area, "area_m2"),
                   100 * number_in(area, "share")));
  }
}

}  // namespace ivo::firmware
