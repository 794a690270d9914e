#include "firmware/files/report_file.hpp"

#include <array>
#include <utility>

#include "firmware/files/json_value.hpp"

namespace ivo::firmware {
namespace {

constexpr int kReportFormat = 1;
constexpr std::array<const char*, 5> kEnds = {"found", "paths_ended", "stopped", "fault", "no_consent"};

}  // namespace

std::string report_json(const ReportDocument& report) {
  Json agents = Json::list();
  for (const ReportedAgent& agent : report.agents) {
    agents.elements.push_back({{"name", agent.name},
                               {"kind", kAgentKindWords[static_cast<std::size_t>(agent.kind)]},
                               {"planned_length_m", agent.planned_length_m},
                               {"distance_m", agent.driven ? Json(agent.driven->distance_m) : Json()},
                               {"mean_speed_mps", agent.driven ? Json(agent.driven->mean_speed_mps) : Json()},
                               {"final_position_m", agent.driven ? Json(agent.driven->final_position) : Json()}});
  }
  return json_text({{"format", kReportFormat},
                    {"mission", report.mission},
                    {"seed", report.seed},
                    {"end", kEnds[static_cast<std::size_t>(report.end)]},
                    {"reason", report.reason},
                    {"finder", json_or_null(report.finder)},
                    {"object_m", json_or_null(report.object)},
                    {"real_search_time_s", report.real_search_time_s},
                    {"plan_score", report.score ? json_of(*report.score) : Json()},
                    {"plan_bounds", report.bounds ? json_of(*report.bounds) : Json()},
                    {"plan_gap", report.bounds ? json_or_null(report.bounds->gap) : Json()},
                    {"agents", std::move(agents)},
                    {"drive_fault", report.drive_fault.empty() ? Json() : Json(report.drive_fault)}});
}

}  // namespace ivo::firmware
