#include "firmware/tools/console/console_command.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "firmware/console/console_client.hpp"
#include "firmware/console/verdict_text.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/loop/loop_status.hpp"
#include "firmware/tools/console/console_texts.hpp"
#include "firmware/tools/console/drawn_file.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

using console::ConsoleClient;
using console::Document;
using console::Kind;
using console::Status;
using console::Verdict;

Result<Json> json_of(ConsoleClient& client, Document document) {
  const Result<std::string> text = client.document(document);
  if (!text) {
    return text.error();
  }
  return text.value().empty() ? Json() : parse_json(text.value(), "the controller", "a document of the console");
}

Result<std::vector<std::string>> agents_of(ConsoleClient& client) {
  const Result<Json> mission = json_of(client, Document::kMission);
  if (!mission) {
    return mission.error();
  }
  std::vector<std::string> names;
  if (const Json* const agents = mission.value().member("agents")) {
    for (const Json& agent : agents->elements) {
      const Json* const name = agent.member("name");
      names.push_back(name != nullptr ? name->text : "");
    }
  }
  return names;
}

// In words, and the exit status.
int tell(const Result<Verdict>& verdict, const Status& status) {
  if (!verdict) {
    return refuse(verdict.error());
  }
  if (verdict.value() != Verdict::kAccepted) {
    complain({"the controller refuses: " + std::string(name_of(verdict.value())) + "; it is " + mode_text(status) +
              asks_text(status)});
    return exit_status::kFaultOrStop;
  }
  say("console", "accepted");
  return exit_status::kEnded;
}

Result<std::size_t> agent_called(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    std::string all;
    for (const std::string& each : names) {
      all += (all.empty() ? "" : ", ") + each;
    }
    return Error{name + ": is no agent of the mission; expected one of " + all};
  }
  return static_cast<std::size_t>(found - names.begin());
}

int show_plan(ConsoleClient& client, const std::vector<std::string>& names) {
  const Result<Json> plan = json_of(client, Document::kPlan);
  const Result<Json> previous = json_of(client, Document::kPreviousPlan);
  if (!plan || !previous) {
    return refuse(!plan ? plan.error() : previous.error());
  }
  show_plans(plan.value(), previous.value(), names);
  return exit_status::kEnded;
}

// What was refused, if it was this time.
Result<std::string> notice_after(ConsoleClient& client, const std::string& before) {
  const Result<std::string> now = client.document(Document::kNotice);
  if (!now || now.value() == before) {
    return now ? Result<std::string>(std::string()) : now;
  }
  const Result<Json> notice = json_of(client, Document::kNotice);
  const Json* const text = notice ? notice.value().member("text") : nullptr;
  return text != nullptr ? text->text : std::string("the plan was refused");
}

// Until the plan is there, or is not to be.
int wait_for_plan(ConsoleClient& client, std::uint32_t before, const std::string& notice_before,
                  const std::vector<std::string>& names) {
  LiveLine line;
  for (;;) {
    const Result<Status> status = client.status();
    const Result<std::string> notice = notice_after(client, notice_before);
    if (!status || !notice) {
      return refuse(!status ? status.error() : notice.error());
    }
    const Status& now = status.value();
    if (!notice.value().empty()) {
      line.end();
      complain({notice.value()});
      return exit_status::kFaultOrStop;
    }
    if (now.finished != 0 || now.mode == static_cast<std::uint8_t>(Mode::kFault)) {
      line.end();
      complain({"no plan was made: the robot is " + mode_text(now)});
      return exit_status::kFaultOrStop;
    }
    if (now.plan_number != before && line.due(now.generation, std::max(1, now.generations))) {
      line.draw("planning",
                format("%d of %d generations, ET %.1f s", now.generation, now.generations, now.expected_time_s));
    }
    if (now.plan_number != before && now.plan_ready != 0 && now.preparing == 0) {
      line.end();
      say("plan", "number " + std::to_string(now.plan_number));
      return show_plan(client, names);
    }
  }
}

int plan_anew(ConsoleClient& client, const Status& status, const ConsoleOptions& options,
              const std::vector<std::string>& names) {
  const bool init = options.verb == ConsoleVerb::kInit;
  const Result<std::string> notice = client.document(Document::kNotice);
  if (!notice) {
    return refuse(notice.error());
  }
  const Result<Verdict> verdict =
      client.command(init ? Kind::kInit : Kind::kReplan, 0, init ? 0 : status.areas_revision);
  if (const int said = tell(verdict, status); said != exit_status::kEnded || !options.wait) {
    return said;
  }
  return wait_for_plan(client, status.plan_number, notice.value(), names);
}

int start(ConsoleClient& client, const Status& status) {
  if (status.accepted == 0) {
    complain({"nobody has accepted the plan; expected `ivo console plan`, then `ivo console accept`"});
    return exit_status::kFaultOrStop;
  }
  warn_of_pose(status);
  return tell(client.command(Kind::kConsent, status.question), status);
}

/// Why the controller would refuse that place, in more words than its verdict has.
Result<void> can_be_placed(ConsoleClient& client, std::size_t agent, const ConsoleOptions& options) {
  const Result<Json> mission = json_of(client, Document::kMission);
  if (!mission) {
    return mission.error();
  }
  const Json* const agents = mission.value().member("agents");
  const Json* const motion = agents != nullptr ? agents->elements.at(agent).member("motion") : nullptr;
  if (motion == nullptr || motion->text != "reported") {
    return Error{"the place of " + options.agent + " is known; expected a person whose motion is \"reported\""};
  }
  const Json* const map = mission.value().member("map");
  const auto side_m = [map](std::string_view name) {
    const Json* const side = map != nullptr ? map->member(name) : nullptr;
    return side != nullptr && side->is_number() ? side->real : 0.0;
  };
  const double width_m = side_m("width_m");
  const double height_m = side_m("height_m");
  const double x_m = options.x_m.value_or(0.0);
  const double y_m = options.y_m.value_or(0.0);
  if (!(x_m >= 0 && y_m >= 0 && x_m <= width_m && y_m <= height_m)) {
    return Error{place_text({x_m, y_m}) + " is off the map; expected 0 to " + format("%g", width_m) + " and 0 to " +
                 format("%g", height_m)};
  }
  return {};
}

int about_agent(ConsoleClient& client, const Status& status, const ConsoleOptions& options,
                const std::vector<std::string>& names) {
  const Result<std::size_t> agent = agent_called(names, options.agent);
  if (!agent) {
    return refuse(agent.error());
  }
  if (options.verb == ConsoleVerb::kFound) {
    return tell(client.command(Kind::kFound, 0, static_cast<std::uint32_t>(agent.value())), status);
  }
  if (const Result<void> placed = can_be_placed(client, agent.value(), options); !placed) {
    return refuse(placed.error());
  }
  console::PoseCommand pose;
  pose.agent = static_cast<std::uint8_t>(agent.value());
  pose.x_m = options.x_m.value_or(0.0);
  pose.y_m = options.y_m.value_or(0.0);
  return tell(client.report(pose), status);
}

int areas(ConsoleClient& client, const ConsoleOptions& options, const std::vector<std::string>& names) {
  if (!options.areas.empty()) {
    if (const Result<void> drawn = draw_file(client, options.areas, names); !drawn) {
      return refuse(drawn.error());
    }
  }
  const Result<Json> now = json_of(client, Document::kAreas);
  if (!now) {
    return refuse(now.error());
  }
  show_areas(now.value(), names);
  return exit_status::kEnded;
}

}  // namespace

int console_command(const ConsoleOptions& options) {
  Result<ConsoleClient> connected = ConsoleClient::connect(options.socket);
  if (!connected) {
    return refuse(connected.error());
  }
  ConsoleClient& client = connected.value();
  const Result<Status> heard = client.status();
  if (!heard) {
    return refuse(heard.error());
  }
  const Status& status = heard.value();
  const auto say_to = [&](Kind kind, std::uint32_t argument = 0) {
    return tell(client.command(kind, status.question, argument), status);
  };
  switch (options.verb) {  // a robot is stopped before anything is read
    case ConsoleVerb::kStop:
      return say_to(Kind::kStop);
    case ConsoleVerb::kPause:
      return say_to(Kind::kPause);
    case ConsoleVerb::kRefuse:
      return say_to(Kind::kNoConsent);
    case ConsoleVerb::kClear:
      return say_to(Kind::kClearFault);
    case ConsoleVerb::kEnough:
      return say_to(Kind::kEnough, status.plan_number);
    case ConsoleVerb::kAccept:
      return say_to(Kind::kAccept, status.plan_number);
    case ConsoleVerb::kConsent:
      warn_of_pose(status);
      return say_to(Kind::kConsent);
    case ConsoleVerb::kStart:
      return start(client, status);
    default:
      break;
  }
  const Result<std::vector<std::string>> names = agents_of(client);
  if (!names) {
    return refuse(names.error());
  }
  switch (options.verb) {
    case ConsoleVerb::kPlan:
      return show_plan(client, names.value());
    case ConsoleVerb::kAreas:
      return areas(client, options, names.value());
    case ConsoleVerb::kInit:
    case ConsoleVerb::kReplan:
      return plan_anew(client, status, options, names.value());
    case ConsoleVerb::kFound:
    case ConsoleVerb::kPosition:
      return about_agent(client, status, options, names.value());
    default:
      show_status(status, names.value());
      return exit_status::kEnded;
  }
}

}  // namespace ivo::firmware
