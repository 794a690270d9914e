#include "firmware/tools/doctor/report_text.hpp"

#include <array>

#include "firmware/tools/doctor/latency_figures.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::array<const char*, 4> kNames{"ok", "warning", "fault", "not checked"};
constexpr std::array<const char*, 4> kColours{"\033[32m", "\033[33m", "\033[1;31m", "\033[2m"};
constexpr const char* kBold = "\033[1m";
constexpr const char* kPlain = "\033[0m";

constexpr int kStateWidth = 11;
constexpr int kCheckWidth = 18;

std::string in_colour(const std::string& text, const char* colour, bool coloured) {
  return coloured ? colour + text + kPlain : text;
}

}  // namespace

const char* name_of(State state) noexcept { return kNames[static_cast<std::size_t>(state)]; }

std::string group_text(const Group& group, bool coloured) {
  std::string text = in_colour(group.name, kBold, coloured) + "\n";
  for (const Finding& finding : group.findings) {
    const char* const colour = kColours[static_cast<std::size_t>(finding.state)];
    text += "  " + in_colour(format("%-*s", kStateWidth, name_of(finding.state)), colour, coloured);
    text += format("  %-*s  ", kCheckWidth, finding.check.c_str()) + finding.found + "\n";
    if (!finding.remedy.empty()) {
      text += std::string(kStateWidth + kCheckWidth + 3, ' ') + "-> " + finding.remedy + "\n";
    }
  }
  return text;
}

std::string latency_text(const LatencyRun& run) {
  std::string text = "  Wake-ups by how late they were, every " + format("%g ms", 1e3 * seconds(run.period)) +
                     ", on CLOCK_MONOTONIC of this host under the load it had:\n";
  text += "  a figure of this machine at this time. Bars by digits of the count; ! is later than the budget.\n\n";
  text += "   from us    to us   wake-ups\n";
  for (const std::string& line : histogram_lines(run)) {
    text += "  " + line + "\n";
  }
  return text;
}

Sum sum_of(std::span<const Group> groups) {
  Sum sum;
  for (const Group& group : groups) {
    for (const Finding& finding : group.findings) {
      const std::array<int*, 4> counts{&sum.ok, &sum.warnings, &sum.faults, &sum.not_checked};
      ++*counts[static_cast<std::size_t>(finding.state)];
    }
  }
  return sum;
}

std::string sum_text(const Sum& sum, bool coloured) {
  const State worst = sum.faults > 0 ? State::kFault : sum.warnings > 0 ? State::kWarning : State::kOk;
  const std::string verdict = sum.faults > 0     ? "not fit for a robot yet: mend the faults first"
                              : sum.warnings > 0 ? "no fault: the warnings are what could be better"
                                                 : "nothing is wrong";
  return in_colour(verdict, kColours[static_cast<std::size_t>(worst)], coloured) + format(" (%d ok, ", sum.ok) +
         counted(sum.warnings, "warning") + ", " + counted(sum.faults, "fault") +
         format(", %d not checked)\n", sum.not_checked);
}

}  // namespace ivo::firmware::doctor
