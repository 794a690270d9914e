#include "firmware/tools/doctor/doctor_document.hpp"

#include <cstdint>

#include "firmware/files/json_value.hpp"
#include "firmware/tools/doctor/latency_figures.hpp"
#include "firmware/tools/doctor/report_text.hpp"

namespace ivo::firmware::doctor {
namespace {

Json latency(const LatencyRun& run) {
  const LatencyFigures figures = figures_of(run);
  Json bins = Json::list();
  for (const Bin& bin : histogram_of(run.late)) {
    bins.elements.push_back({{"from_us", static_cast<std::uint64_t>(bin.from_us)},
                             {"to_us", static_cast<std::uint64_t>(bin.to_us)},
                             {"count", bin.count}});
  }
  return {{"clock", "CLOCK_MONOTONIC of this host"},
          {"thread", thread_text(run)},
          {"real_time", run.real_time},
          {"locked_memory", run.locked},
          {"period_us", microseconds(run.period)},
          {"wake_ups", std::uint64_t{run.late.size()}},
          {"least_us", microseconds(figures.least)},
          {"median_us", microseconds(figures.median)},
          {"p99_us", microseconds(figures.p99)},
          {"p999_us", microseconds(figures.p999)},
          {"most_us", microseconds(figures.most)},
          {"budget_us", microseconds(figures.budget)},
          {"over_budget", figures.over_budget},
          {"lost_periods", run.lost_periods},
          {"page_faults", run.faults.minor + run.faults.major},
          {"histogram", bins}};
}

}  // namespace

std::string doctor_json(const std::string& robot, std::span<const Group> groups, const std::optional<LatencyRun>& run) {
  Json checks = Json::list();
  for (const Group& group : groups) {
    for (const Finding& finding : group.findings) {
      checks.elements.push_back({{"group", group.name},
                                 {"check", finding.check},
                                 {"state", name_of(finding.state)},
                                 {"found", finding.found},
                                 {"remedy", finding.remedy.empty() ? Json() : Json(finding.remedy)}});
    }
  }
  const Sum sum = sum_of(groups);
  return json_text(
      {{"format", 1},
       {"robot", robot},
       {"sum", {{"ok", sum.ok}, {"warning", sum.warnings}, {"fault", sum.faults}, {"not_checked", sum.not_checked}}},
       {"checks", checks},
       {"latency", run ? latency(*run) : Json()}});
}

}  // namespace ivo::firmware::doctor
