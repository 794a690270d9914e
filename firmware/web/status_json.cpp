#include "firmware/web/status_json.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "firmware/loop/loop_status.hpp"
#include "firmware/mission/search_run.hpp"
#include "firmware/safety/mode.hpp"
#include "firmware/web/compact_json.hpp"
#include "firmware/web/fault_kind.hpp"

namespace ivo::firmware::web {
namespace {

/// What a number of the controller's means; one that this program does not know is said so.
template <std::size_t N>
std::string_view word(const std::array<std::string_view, N>& words, std::size_t number) {
  return number < N ? words[number] : "unknown";
}

constexpr std::array<std::string_view, 4> kLinks{"none", "connected", "silent", "absent"};
constexpr std::array<std::string_view, 3> kAsked{"nothing", "consent", "clearing"};
constexpr std::array<std::string_view, 3> kSearches{"running", "found", "paths_ended"};
constexpr std::array<std::string_view, 5> kPauseCauses{"none", "asked", "beat_lost", "replan", "no_go"};
constexpr std::array<std::string_view, 4> kWheels{"front_left", "front_right", "rear_left", "rear_right"};
constexpr std::array<std::string_view, 4> kStopCauses{"none", "asked", "no_consent", "plan_not_kept"};
static_assert(static_cast<int>(SearchState::kPathsEnded) == 2 && static_cast<int>(StopCause::kPlanNotKept) == 3 &&
              static_cast<int>(Wheel::kRearRight) == 3 && static_cast<int>(PauseCause::kNoGo) == 4);

std::string_view mode_word(std::uint8_t mode) { return mode < kModes ? name_of(static_cast<Mode>(mode)) : "unknown"; }

void put_plan(const console::Status& status, CompactJson& json) {
  json.key("plan").open('{');
  json.key("number").count(status.plan_number);
  json.key("ready").flag(status.plan_ready != 0);
  json.key("accepted").flag(status.accepted != 0);
  json.key("preparing").flag(status.preparing != 0);
  json.key("with_preferences").flag(status.with_preferences != 0);
  json.key("followed").flag(status.plan_followed != 0);
  json.key("into_no_go");
  status.into_no_go == console::Status::kNobody ? json.null() : json.count(status.into_no_go);
  json.key("generation").number(status.generation);
  json.key("generations").number(status.generations).close('}');
}

void put_search(const console::Status& status, CompactJson& json) {
  json.key("search").open('{');
  json.key("state").text(word(kSearches, status.search));
  json.key("started").flag(status.search_started != 0);
  json.key("time_s").number(static_cast<double>(status.search_time_ns) / 1e9);
  json.key("finder");
  status.finder == console::Status::kNobody ? json.null() : json.count(status.finder);
  json.key("searched").number(status.searched_mass).close('}');
}

void put_agents(const console::Status& status, CompactJson& json) {
  json.key("agents").open('[');
  for (std::size_t i = 0; i < status.agents; ++i) {
    const console::AgentStatus& agent = status.agent[i];
    json.open('{');
    json.key("x_m").number(agent.x_m);
    json.key("y_m").number(agent.y_m);
    json.key("moved_m").number(agent.moved_m);
    json.key("left_m").number(agent.left_m);
    json.key("path_ended").flag(agent.path_ended != 0);
    json.key("reported").flag(agent.reported != 0);
    json.key("report_age_s");
    agent.report_age_s < 0.0 ? json.null() : json.number(agent.report_age_s);
    json.close('}');
  }
  json.close(']');
}

void put_fault(const console::Status& status, CompactJson& json) {
  json.key("fault").text(status.fault.data());
  json.key("fault_kind").text(fault_kind(static_cast<drivers::DriveFaultReason>(status.fault_reason)));
  json.key("fault_wheel");
  status.fault_node_id == 0 ? json.null() : json.text(word(kWheels, status.fault_wheel));
}

void put_status(const console::Status& status, CompactJson& json) {
  json.key("time_s").number(static_cast<double>(status.at_ns) / 1e9);
  json.key("mode").text(mode_word(status.mode));
  json.key("asks").text(word(kAsked, static_cast<std::size_t>(status.asks)));
  json.key("question").count(status.question);
  put_plan(status, json);
  json.key("areas_revision").count(status.areas_revision);
  put_search(status, json);
  json.key("pause_cause").text(word(kPauseCauses, static_cast<std::size_t>(status.pause_cause)));
  json.key("stop_cause").text(word(kStopCauses, status.stop_cause));
  json.key("finished").flag(status.finished != 0);
  put_agents(status, json);
  json.key("heading_rad").number(status.heading_rad);
  put_fault(status, json);
  json.key("stop_held").flag(status.stop_held != 0);
  json.key("taken_up").flag(status.taken_up != 0);
}

void put_screen(const ScreenEntry& entry, bool with_kind, CompactJson& json) {
  json.open('{');
  json.key("screen").count(entry.screen);
  json.key("name").text(entry.name);
  if (with_kind) {
    json.key("kind").text(entry.ros ? "ros" : "page");
  }
  json.close('}');
}

void put_named(std::string_view key, const std::optional<Screen>& screen, const Desk& desk, CompactJson& json) {
  json.key(key);
  for (const ScreenEntry& entry : desk.screens) {
    if (screen == entry.screen) {
      put_screen(entry, false, json);
      return;
    }
  }
  screen ? put_screen({.screen = *screen, .name = "", .ros = false}, false, json) : static_cast<void>(json.null());
}

void put_refusals(const Refusals& refusals, CompactJson& json) {
  json.key("refused").open('{');
  for (const Verdict verdict : {Verdict::kMalformed, Verdict::kTooLarge, Verdict::kOutOfOrder, Verdict::kReplayed,
                                Verdict::kTooOften, Verdict::kNotAllowed, Verdict::kNotFresh, Verdict::kNoController}) {
    json.key(name_of(verdict)).count(refusals.of(verdict));
  }
  json.key("by_controller").count(refusals.by_controller());
  json.key("foreign_origin").count(refusals.foreign_origin());
  json.key("foreign_host").count(refusals.foreign_host());
  json.key("not_paired").count(refusals.not_paired());
  json.key("wrong_code").count(refusals.wrong_code()).close('}');
}

/// To the centimetre: nobody sees more of it.
double rounded(double length_m) { return std::round(length_m * 100.0) / 100.0; }

}  // namespace

std::string common_status(const View& view, const Desk& desk, Instant now) {
  CompactJson json;
  json.open('{').key("type").text("status");
  json.key("controller").text(word(kLinks, static_cast<std::size_t>(view.link)));
  json.key("controller_age_s");
  view.link == LinkState::kNone ? json.null() : json.number(seconds(now - view.heard_at));
  if (view.status) {
    put_status(*view.status, json);
  }
  put_named("operator", desk.holder, desk, json);
  put_named("request", desk.requester, desk, json);
  json.key("screens").open('[');
  for (const ScreenEntry& entry : desk.screens) {
    put_screen(entry, true, json);
  }
  json.close(']');
  put_refusals(desk.refusals, json);
  return json.written();
}

std::string status_text(const std::string& common, bool start_fresh, std::uint32_t number) {
  return common + (start_fresh ? ",\"start_fresh\":true" : ",\"start_fresh\":false") +
         ",\"n\":" + std::to_string(number) + "}";
}

std::string hello_text(Screen screen, std::string_view name, bool may_operate) {
  CompactJson json;
  json.open('{').key("type").text("hello").key("protocol").count(1);
  json.key("screen").count(screen).key("name").text(name).key("may_operate").flag(may_operate).close('}');
  return json.written();
}

std::string answer_text(std::uint32_t sequence, Verdict verdict) {
  CompactJson json;
  json.open('{').key("type").text("answer").key("seq").count(sequence);
  json.key("verdict").text(name_of(verdict)).close('}');
  return json.written();
}

std::string document_text(std::string_view name, std::uint32_t revision, std::string_view value) {
  CompactJson json;
  json.open('{').key("type").text("document").key("name").text(name).key("revision").count(revision);
  json.key("value").raw(value.empty() ? "null" : value).close('}');
  return json.written();
}

std::string grid_text(std::string_view name, std::uint32_t revision) {
  CompactJson json;
  json.open('{').key("type").text("grid").key("name").text(name).key("revision").count(revision).close('}');
  return json.written();
}

std::string layer_text(const Layer& layer, Instant now) {
  static constexpr std::array<std::string_view, kLayers> kNames{"scan", "people", "robot_pose"};
  CompactJson json;
  json.open('{').key("type").text("layer").key("name").text(word(kNames, static_cast<std::size_t>(layer.name)));
  json.key("age_s").number(seconds(now - layer.at)).key("points_m").open('[');
  for (const Point& point : layer.points) {
    json.open('[').number(rounded(point.x_m)).number(rounded(point.y_m)).close(']');
  }
  json.close(']');
  if (layer.name == LayerName::kRobotPose) {
    json.key("heading_rad").number(layer.heading_rad);
  }
  json.close('}');
  return json.written();
}

std::string error_text(std::string_view code) {
  CompactJson json;
  json.open('{').key("error").text(code).close('}');
  return json.written();
}

std::string error_text(std::string_view code, std::string_view name, int number) {
  CompactJson json;
  json.open('{').key("error").text(code).key(name).number(number).close('}');
  return json.written();
}

}  // namespace ivo::firmware::web
