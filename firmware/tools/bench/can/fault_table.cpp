#include "firmware/tools/bench/can/fault_table.hpp"

#include <fnmatch.h>

#include <algorithm>

#include "firmware/tools/bench/can/fault_trial.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr double kToldWithin_cycles = 1.0;

void add_stop(Sheet& sheet, const std::string& name, const FaultRow& row, const FaultFigures& figures) {
  const double never = -1.0;  // fails each target below by its sign
  const auto add = [&](const char* figure, std::optional<double> value, const char* unit, double most) {
    if (value) {
      sheet.add(name, figure, *value, unit, Target{most, Sense::kAtMost});
    } else {
      sheet.add(name, std::string(figure) + ": never", never, unit, Target{0.0, Sense::kAtLeast});
    }
  };
  add("detected", figures.detected_ms, "ms", seconds(row.detected_within) * 1e3);
  add("told to stop", figures.told_cycles ? std::optional<double>(*figures.told_cycles) : std::nullopt, "cycles",
      kToldWithin_cycles);
  add("at rest", figures.rest_ms, "ms", figures.rest_limit_ms);
}

void add_row(Sheet& sheet, const FaultRow& row) {
  const std::string name = std::to_string(row.number) + " " + row.name;
  if (!row.skip.empty()) {
    return sheet.skip(name, row.skip);
  }
  const Result<FaultFigures> tried = try_fault(row);
  if (!tried) {
    return sheet.skip(name, tried.error().message);
  }
  const FaultFigures& figures = tried.value();
  sheet.add_text(name, "provoked by", row.by, true);
  if (row.outcome == Outcome::kStops || row.outcome == Outcome::kStopsBus) {
    add_stop(sheet, name, row, figures);
  }
  if (row.outcome != Outcome::kGoesOn) {
    sheet.add(name, "moved unasked", figures.unasked, "", Target{0.0, Sense::kAtMost});
    sheet.add(name, "moves again", figures.moves_again ? 1.0 : 0.0, "",
              Target{row.recovers ? 1.0 : 0.0, row.recovers ? Sense::kAtLeast : Sense::kAtMost});
  } else {
    sheet.add(name, "goes on", figures.moves_again ? 1.0 : 0.0, "", Target{1.0, Sense::kAtLeast});
  }
  if (row.loses_frames) {
    sheet.add(name, "frames lost, counted", static_cast<double>(figures.frames_lost), "", Target{1.0, Sense::kAtLeast});
  }
  if (figures.ready_ms) {
    sheet.add(name, "ready again", *figures.ready_ms, "ms");
  }
  sheet.add_text(name, "says", figures.says, fnmatch(row.says.c_str(), figures.says.c_str(), 0) == 0);
}

}  // namespace

std::vector<FaultRow> fault_rows() {
  std::vector<FaultRow> all;
  for (const auto& group : {faults_of_drives, faults_of_feedback, faults_of_bus, faults_of_others, faults_at_start,
                            faults_of_loop, faults_of_inputs}) {
    for (FaultRow& row : group()) {
      all.push_back(row);
      if (row.also_at_1khz) {
        row.name += ", 1 kHz";
        row.layout = PdoLayout::kShared;
        all.push_back(std::move(row));
      }
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const FaultRow& a, const FaultRow& b) { return a.number < b.number; });
  return all;
}

void fault_table(Sheet& sheet) {
  sheet.clock("simulated time, in lock step");
  const std::vector<FaultRow> rows = fault_rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    add_row(sheet, rows[i]);
  }
}

}  // namespace ivo::firmware::bench
