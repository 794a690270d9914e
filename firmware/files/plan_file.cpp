#include "firmware/files/plan_file.hpp"

#include <limits>
#include <utility>

#include "firmware/files/json_reading.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {
namespace {

constexpr int kPlanFormat = 2;
constexpr const char* kWhat = "a plan";

ScoreDocument read_score(JsonReading& reading, const Json& json) {
  ScoreDocument score;
  score.expected_time_s = reading.number(json, "score.", "expected_time_s", 0.0, 1e9);
  score.expected_time_continuous_s = reading.number(json, "score.", "expected_time_continuous_s", 0.0, 1e9);
  if (const Json* const time = reading.field(json, "score.", "expected_sub_prior_time_s");
      time != nullptr && time->kind != Json::Kind::kNull) {
    score.expected_sub_prior_time_s = reading.number(json, "score.", "expected_sub_prior_time_s", 0.0, 1e9);
  }
  score.unseen_mass = reading.number(json, "score.", "unseen_mass", 0.0, 1.0);
  score.horizon_s = reading.number(json, "score.", "horizon_s", 0.0, 1e9);
  score.complete = reading.flag(json, "score.", "complete");
  return score;
}

BoundsDocument read_bounds(JsonReading& reading, const Json& json) {
  return {.area_s = reading.number(json, "bounds.", "area_s", 0.0, 1e9),
          .area_strict_s = reading.number(json, "bounds.", "area_strict_s", 0.0, 1e9),
          .reach_s = reading.number(json, "bounds.", "reach_s", 0.0, 1e9),
          .reach_strict_s = reading.number(json, "bounds.", "reach_strict_s", 0.0, 1e9),
          .gap = {}};
}

std::vector<Point> read_waypoints(JsonReading& reading, const Json& agent, const std::string& at) {
  std::vector<Point> points;
  const Json& waypoints = reading.list(agent, at, "waypoints_m");
  for (std::size_t i = 0; i < waypoints.elements.size() && reading.ok(); ++i) {
    points.push_back(reading.point(waypoints.elements[i], at + element("waypoints_m", i)));
  }
  return points;
}

PlannedAgent read_agent(JsonReading& reading, const Json& json, const std::string& at) {
  PlannedAgent agent;
  agent.name = reading.text(json, at, "name");
  agent.kind = static_cast<AgentKind>(reading.choice(json, at, "kind", kAgentKindWords));
  agent.speed_mps = reading.number(json, at, "speed_mps", 0.0, 100.0);
  agent.sight_radius_m = reading.number(json, at, "sight_radius_m", 0.0, 1e4);
  agent.length_m = reading.number(json, at, "length_m", 0.0, 1e9);
  agent.duration_s = reading.number(json, at, "duration_s", 0.0, 1e9);
  agent.waypoints = read_waypoints(reading, json, at);
  return agent;
}

PlanDocument read_document(JsonReading& reading, const Json& json) {
  PlanDocument plan;
  if (json.kind != Json::Kind::kObject) {
    reading.fault("", "is no object; expected what plan writes");
    return plan;
  }
  const std::uint64_t format = reading.count(json, "", "format", std::numeric_limits<std::uint64_t>::max());
  if (reading.ok() && format != kPlanFormat) {
    reading.fault("format", std::to_string(format) + " is another version of this file's form; expected 2");
  }
  plan.mission = reading.text(json, "", "mission");
  plan.map = reading.text(json, "", "map");
  plan.seed = reading.count(json, "", "seed", std::numeric_limits<std::uint64_t>::max());
  plan.profile = static_cast<SearchProfile>(reading.choice(json, "", "profile", kSearchProfileWords));
  plan.heuristic = static_cast<SearchHeuristic>(reading.choice(json, "", "heuristic", kSearchHeuristicWords));
  constexpr std::uint64_t kMostCount = std::numeric_limits<int>::max();
  plan.threads = static_cast<int>(reading.count(json, "", "threads", kMostCount));
  plan.capacity = reading.text(json, "", "capacity");
  plan.cell_m = reading.number(json, "", "cell_m", 0.0, 1e4);
  plan.spacing_m = reading.number(json, "", "spacing_m", 0.0, 1e4);
  plan.nodes = static_cast<int>(reading.count(json, "", "nodes", kMostCount));
  plan.generations_done = static_cast<int>(reading.count(json, "", "generations_done", kMostCount));
  plan.unobservable_share = reading.number(json, "", "unobservable_share", 0.0, 1.0);
  if (const Json* const score = reading.field(json, "", "score")) {
    plan.score = read_score(reading, *score);
  }
  if (const Json* const bounds = reading.field(json, "", "bounds")) {
    plan.bounds = read_bounds(reading, *bounds);
  }
  if (const Json* const gap = reading.field(json, "", "gap"); gap != nullptr && gap->kind != Json::Kind::kNull) {
    plan.bounds.gap = reading.number(gap, "gap", -1.0, 1e9);
  }
  const Json& agents = reading.list(json, "", "agents");
  for (std::size_t i = 0; i < agents.elements.size() && reading.ok(); ++i) {
    plan.agents.push_back(read_agent(reading, agents.elements[i], element("agents", i) + "."));
  }
  return plan;
}

Result<Json> read_document_of(const std::string& path) {
  const Result<std::string> text = read_file(path);
  if (!text) {
    return Error{text.error().message + "; expected " + kWhat};
  }
  return parse_json(text.value(), path, kWhat);
}

}  // namespace

std::string plan_json(const PlanDocument& plan) {
  Json agents = Json::list();
  for (const PlannedAgent& agent : plan.agents) {
    Json waypoints = Json::list();
    for (const Point& p : agent.waypoints) {
      waypoints.elements.emplace_back(p);
    }
    agents.elements.push_back({{"name", agent.name},
                               {"kind", kAgentKindWords[static_cast<std::size_t>(agent.kind)]},
                               {"speed_mps", agent.speed_mps},
                               {"sight_radius_m", agent.sight_radius_m},
                               {"length_m", agent.length_m},
                               {"duration_s", agent.duration_s},
                               {"waypoints_m", std::move(waypoints)}});
  }
  return json_text({{"format", kPlanFormat},
                    {"mission", plan.mission},
                    {"map", plan.map},
                    {"seed", plan.seed},
                    {"profile", kSearchProfileWords[static_cast<std::size_t>(plan.profile)]},
                    {"heuristic", kSearchHeuristicWords[static_cast<std::size_t>(plan.heuristic)]},
                    {"threads", plan.threads},
                    {"capacity", plan.capacity},
                    {"cell_m", plan.cell_m},
                    {"spacing_m", plan.spacing_m},
                    {"nodes", plan.nodes},
                    {"generations_done", plan.generations_done},
                    {"unobservable_share", plan.unobservable_share},
                    {"score", json_of(plan.score)},
                    {"bounds", json_of(plan.bounds)},
                    {"gap", json_or_null(plan.bounds.gap)},
                    {"agents", std::move(agents)}});
}

Result<PlanDocument> read_plan(const std::string& path) {
  const Result<Json> json = read_document_of(path);
  if (!json) {
    return json.error();
  }
  JsonReading reading(path);
  PlanDocument plan = read_document(reading, json.value());
  if (!reading.ok()) {
    return reading.error();
  }
  return plan;
}

Result<std::vector<ForeignPath>> read_paths(const std::string& path) {
  const Result<Json> json = read_document_of(path);
  if (!json) {
    return json.error();
  }
  JsonReading reading(path);
  std::vector<ForeignPath> paths;
  if (json.value().kind != Json::Kind::kObject) {
    reading.fault("", "is no object; expected { \"agents\": [...] }");
    return reading.error();
  }
  const Json& agents = reading.list(json.value(), "", "agents");
  for (std::size_t i = 0; i < agents.elements.size() && reading.ok(); ++i) {
    const Json& agent = agents.elements[i];
    const std::string at = element("agents", i) + ".";
    ForeignPath& foreign = paths.emplace_back();
    if (agent.member("name") != nullptr) {
      foreign.agent = reading.text(agent, at, "name");
    }
    foreign.waypoints = read_waypoints(reading, agent, at);
  }
  if (!reading.ok()) {
    return reading.error();
  }
  return paths;
}

}  // namespace ivo::firmware
