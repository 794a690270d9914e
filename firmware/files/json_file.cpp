// The only file that includes nlohmann-json, which takes seconds to compile.
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "firmware/files/number_text.hpp"
#include "firmware/files/plan_file.hpp"
#include "firmware/files/report_file.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr std::array<const char*, kAgentKinds> kKinds = {"robot", "person"};
constexpr std::array<const char*, 5> kEnds = {"found", "paths_ended", "stopped", "fault", "no_consent"};

Json json_of(Point p) { return Json::array({p.x_m, p.y_m}); }

Json json_of(const ScoreDocument& s) {
  return {
      {"expected_time_s", s.expected_time_s},
      {"expected_time_continuous_s", s.expected_time_continuous_s},
      {"expected_sub_prior_time_s", s.expected_sub_prior_time_s ? Json(*s.expected_sub_prior_time_s) : Json(nullptr)},
      {"unseen_mass", s.unseen_mass},
      {"horizon_s", s.horizon_s},
      {"complete", s.complete}};
}

/// Names and reasons may come from elsewhere: what is not UTF-8 is shown as such instead of ending the program.
std::string compact(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// A field a line and an agent a line, so that a person can read the file and see what changed between two.
std::string text_of(const Json& document) {
  std::string text = "{";
  for (const auto& [key, value] : document.items()) {
    text += (text.size() == 1 ? "\n  " : ",\n  ") + compact(Json(key)) + ": ";
    if (!value.is_array() || value.empty() || !value.front().is_object()) {
      text += compact(value);
      continue;
    }
    std::string lines;
    for (const Json& element : value) {
      lines += (lines.empty() ? "\n    " : ",\n    ") + compact(element);
    }
    text += "[" + lines + "\n  ]";
  }
  return text + "\n}\n";
}

/// Reads fields one by one; after the first fault it answers with defaults and keeps the fault.
class Reading {
 public:
  explicit Reading(std::string path) : path_(std::move(path)) {}

  void fault(const std::string& field, const std::string& what) {
    if (fault_.empty()) {
      fault_ = path_ + ": " + (field.empty() ? "" : field + ": ") + what;
    }
  }
  [[nodiscard]] bool ok() const { return fault_.empty(); }
  [[nodiscard]] Error error() const { return Error{fault_}; }

  const Json* field(const Json& object, const std::string& at, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end()) {
      fault(at + key, "missing; it must be given");
      return nullptr;
    }
    return &*found;
  }

  std::string text(const Json& object, const std::string& at, const char* key) {
    const Json* const value = field(object, at, key);
    if (value == nullptr || !value->is_string()) {
      fault(at + key, "is no text; expected text");
      return {};
    }
    return value->get<std::string>();
  }

  bool flag(const Json& object, const std::string& at, const char* key) {
    const Json* const value = field(object, at, key);
    if (value == nullptr || !value->is_boolean()) {
      fault(at + key, "is no flag; expected true or false");
      return false;
    }
    return value->get<bool>();
  }

  double number(const Json* value, const std::string& name, double least, double most) {
    const bool right =
        value != nullptr && value->is_number() && value->get<double>() >= least && value->get<double>() <= most;
    if (!right) {
      const std::string found = value != nullptr && value->is_number() ? shortest(value->get<double>()) : "this";
      fault(name, found + " will not do; expected a number, " + shortest(least) + " to " + shortest(most));
      return least;
    }
    return value->get<double>();
  }
  double number(const Json& object, const std::string& at, const char* key, double least, double most) {
    return number(field(object, at, key), at + key, least, most);
  }

  std::uint64_t count(const Json& object, const std::string& at, const char* key, std::uint64_t most) {
    const Json* const value = field(object, at, key);
    if (value == nullptr || !value->is_number_unsigned() || value->get<std::uint64_t>() > most) {
      fault(at + key, "is no count; expected a whole number, 0 to " + std::to_string(most));
      return 0;
    }
    return value->get<std::uint64_t>();
  }

  AgentKind kind(const Json& object, const std::string& at) {
    const std::string word = text(object, at, "kind");
    for (std::size_t i = 0; i < kKinds.size(); ++i) {
      if (word == kKinds[i]) {
        return static_cast<AgentKind>(i);
      }
    }
    fault(at + "kind", "\"" + word + "\" is unknown; expected \"robot\" or \"person\"");
    return AgentKind::kRobot;
  }

  /// Empty, with the fault kept, when it is no list of at least one.
  const Json& list(const Json& object, const std::string& at, const char* key) {
    static const Json kEmpty = Json::array();
    const Json* const value = field(object, at, key);
    if (value == nullptr || !value->is_array() || value->empty()) {
      fault(at + key, "is no list; expected a list of at least one");
      return kEmpty;
    }
    return *value;
  }

  Point point(const Json& value, const std::string& name) {
    if (!value.is_array() || value.size() != 2) {
      fault(name, "is no point; expected [x, y]");
      return {};
    }
    return {number(&value[0], name, -kFar, kFar), number(&value[1], name, -kFar, kFar)};
  }

  static constexpr double kFar = 1e6;

 private:
  std::string path_;
  std::string fault_;
};

std::string element(const char* list, std::size_t i) { return std::string(list) + "[" + std::to_string(i) + "]"; }

ScoreDocument read_score(Reading& reading, const Json& json) {
  ScoreDocument score;
  score.expected_time_s = reading.number(json, "score.", "expected_time_s", 0.0, 1e9);
  score.expected_time_continuous_s = reading.number(json, "score.", "expected_time_continuous_s", 0.0, 1e9);
  if (const Json* const time = reading.field(json, "score.", "expected_sub_prior_time_s");
      time != nullptr && !time->is_null()) {
    score.expected_sub_prior_time_s = reading.number(json, "score.", "expected_sub_prior_time_s", 0.0, 1e9);
  }
  score.unseen_mass = reading.number(json, "score.", "unseen_mass", 0.0, 1.0);
  score.horizon_s = reading.number(json, "score.", "horizon_s", 0.0, 1e9);
  score.complete = reading.flag(json, "score.", "complete");
  return score;
}

PlannedAgent read_agent(Reading& reading, const Json& json, const std::string& at) {
  PlannedAgent agent;
  agent.name = reading.text(json, at, "name");
  agent.kind = reading.kind(json, at);
  agent.speed_mps = reading.number(json, at, "speed_mps", 0.0, 100.0);
  agent.sight_radius_m = reading.number(json, at, "sight_radius_m", 0.0, 1e4);
  agent.length_m = reading.number(json, at, "length_m", 0.0, 1e9);
  agent.duration_s = reading.number(json, at, "duration_s", 0.0, 1e9);
  const Json& waypoints = reading.list(json, at, "waypoints_m");
  for (std::size_t i = 0; i < waypoints.size() && reading.ok(); ++i) {
    agent.waypoints.push_back(reading.point(waypoints[i], at + element("waypoints_m", i)));
  }
  return agent;
}

PlanDocument read_document(Reading& reading, const Json& json) {
  PlanDocument plan;
  if (!json.is_object()) {
    reading.fault("", "is no object; expected what plan writes");
    return plan;
  }
  const std::uint64_t format = reading.count(json, "", "format", std::numeric_limits<std::uint64_t>::max());
  if (reading.ok() && format != kFormat) {
    reading.fault("format", std::to_string(format) + " is another version of this file's form; expected 1");
  }
  plan.mission = reading.text(json, "", "mission");
  plan.map = reading.text(json, "", "map");
  plan.seed = reading.count(json, "", "seed", std::numeric_limits<std::uint64_t>::max());
  plan.profile = reading.text(json, "", "profile");
  plan.cell_m = reading.number(json, "", "cell_m", 0.0, 1e4);
  plan.spacing_m = reading.number(json, "", "spacing_m", 0.0, 1e4);
  constexpr std::uint64_t kMostCount = std::numeric_limits<int>::max();
  plan.nodes = static_cast<int>(reading.count(json, "", "nodes", kMostCount));
  plan.generations_done = static_cast<int>(reading.count(json, "", "generations_done", kMostCount));
  plan.unobservable_share = reading.number(json, "", "unobservable_share", 0.0, 1.0);
  if (const Json* const score = reading.field(json, "", "score")) {
    plan.score = read_score(reading, *score);
  }
  const Json& agents = reading.list(json, "", "agents");
  for (std::size_t i = 0; i < agents.size() && reading.ok(); ++i) {
    plan.agents.push_back(read_agent(reading, agents[i], element("agents", i) + "."));
  }
  return plan;
}

}  // namespace

std::string plan_json(const PlanDocument& plan) {
  Json agents = Json::array();
  for (const PlannedAgent& agent : plan.agents) {
    Json waypoints = Json::array();
    for (const Point& p : agent.waypoints) {
      waypoints.push_back(json_of(p));
    }
    agents.push_back({{"name", agent.name},
                      {"kind", kKinds[static_cast<std::size_t>(agent.kind)]},
                      {"speed_mps", agent.speed_mps},
                      {"sight_radius_m", agent.sight_radius_m},
                      {"length_m", agent.length_m},
                      {"duration_s", agent.duration_s},
                      {"waypoints_m", std::move(waypoints)}});
  }
  const Json json = {{"format", kFormat},
                     {"mission", plan.mission},
                     {"map", plan.map},
                     {"seed", plan.seed},
                     {"profile", plan.profile},
                     {"cell_m", plan.cell_m},
                     {"spacing_m", plan.spacing_m},
                     {"nodes", plan.nodes},
                     {"generations_done", plan.generations_done},
                     {"unobservable_share", plan.unobservable_share},
                     {"score", json_of(plan.score)},
                     {"agents", std::move(agents)}};
  return text_of(json);
}

std::string report_json(const ReportDocument& report) {
  Json agents = Json::array();
  for (const ReportedAgent& agent : report.agents) {
    agents.push_back({{"name", agent.name},
                      {"kind", kKinds[static_cast<std::size_t>(agent.kind)]},
                      {"planned_length_m", agent.planned_length_m},
                      {"distance_m", agent.driven ? Json(agent.driven->distance_m) : Json(nullptr)},
                      {"mean_speed_mps", agent.driven ? Json(agent.driven->mean_speed_mps) : Json(nullptr)},
                      {"final_position_m", agent.driven ? json_of(agent.driven->final_position) : Json(nullptr)}});
  }
  const Json json = {{"format", kFormat},
                     {"mission", report.mission},
                     {"seed", report.seed},
                     {"end", kEnds[static_cast<std::size_t>(report.end)]},
                     {"reason", report.reason},
                     {"finder", report.finder ? Json(*report.finder) : Json(nullptr)},
                     {"object_m", report.object ? json_of(*report.object) : Json(nullptr)},
                     {"real_search_time_s", report.real_search_time_s},
                     {"plan_score", report.score ? json_of(*report.score) : Json(nullptr)},
                     {"agents", std::move(agents)},
                     {"drive_fault", report.drive_fault.empty() ? Json(nullptr) : Json(report.drive_fault)}};
  return text_of(json);
}

Result<PlanDocument> read_plan(const std::string& path) {
  const Result<std::string> text = read_file(path);
  if (!text) {
    return Error{text.error().message + "; expected a plan"};
  }
  const Json json = Json::parse(text.value(), nullptr, false);
  if (json.is_discarded()) {
    return Error{path + ": not JSON; expected a plan"};
  }
  Reading reading(path);
  PlanDocument plan = read_document(reading, json);
  if (!reading.ok()) {
    return reading.error();
  }
  return plan;
}

}  // namespace ivo::firmware
