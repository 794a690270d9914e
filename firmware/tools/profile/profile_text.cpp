#include "firmware/tools/profile/profile_text.hpp"

#include <string_view>

#include "firmware/tools/profile/histogram_text.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

double number(Duration time) { return static_cast<double>(time.count()); }
std::string rounded(double value) { return grouped(static_cast<std::uint64_t>(value + 0.5)); }
double percent(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; }

std::string title(const char* name, std::uint64_t count, const char* of) {
  return format("\n%s, %s %s\n  %-16s%10s%9s%9s%10s%9s", name, grouped(count).c_str(), of, "us", "median", "p99",
                "p99.9", "worst", "share");
}

std::string row(std::string_view name, const TimeHistogram& times) {
  return format("  %-16s%10.2f%9.2f%9.2f%10.2f", std::string(name).c_str(), microseconds(times.quantile(0.5)),
                microseconds(times.quantile(0.99)), microseconds(times.quantile(0.999)), microseconds(times.worst()));
}
std::string row(std::string_view name, const TimeHistogram& times, Duration whole) {
  return row(name, times) + format("%7.1f %%", percent(number(times.total()), number(whole)));
}

/// The same times as shares of a period.
std::string budget_row(const TimeHistogram& cycle, Duration period) {
  const auto share = [&](Duration time) { return percent(number(time), number(period)); };
  const Duration mean = cycle.total() / static_cast<Duration::rep>(cycle.count());
  return format("  %-16s%8.2f %%%7.1f %%%7.1f %%%8.1f %%   mean %.2f %%\n", "of the budget", share(cycle.quantile(0.5)),
                share(cycle.quantile(0.99)), share(cycle.quantile(0.999)), share(cycle.worst()), share(mean));
}

std::string cycles_text(const char* name, const CycleFigures& figures, Duration period) {
  const TimeHistogram& cycle = figures.cycle;
  if (cycle.count() == 0) {
    return format("\n%s: none\n", name);
  }
  std::string text = title(name, cycle.count(), "cycles") + "\n";
  for (std::size_t phase = 0; phase < kPhases; ++phase) {
    text += row(name_of(static_cast<Phase>(phase)), figures.phases.at(phase), cycle.total()) + "\n";
  }
  return text + row("whole cycle", cycle) + "\n" + budget_row(cycle, period) + "\n" + histogram_text(cycle);
}

double a_second(std::int64_t count, Duration time) {
  return time > Duration::zero() ? static_cast<double>(count) / seconds(time) : 0.0;
}

std::string steps_text(const CycleProfile& profile) {
  Duration thinking{};
  Duration undisturbed{};
  std::uint64_t slices = 0;
  std::int64_t units = 0;
  std::int64_t moves = 0;
  for (const StepFigures& step : profile.steps) {
    thinking += step.slices.total();
    undisturbed += step.undisturbed();
    slices += step.slices.count();
    units += step.units;
    moves += step.moves;
  }
  if (slices == 0) {
    return {};
  }
  std::string text = title("steps of the planner", slices, "slices") + "   slices  ns/unit    moves/s\n";
  for (std::size_t kind = 0; kind < profile.steps.size(); ++kind) {
    const StepFigures& step = profile.steps.at(kind);
    if (step.slices.count() > 0) {
      text += row(name_of(static_cast<planner::SliceKind>(kind)), step.slices, thinking) +
              format("%9s%9.2f%11s\n", grouped(step.slices.count()).c_str(),
                     microseconds(step.thousand_units.quantile(0.5)),
                     step.moves > 0 ? rounded(a_second(step.moves, step.undisturbed())).c_str() : "-");
    }
  }
  return text + "  " + rounded(a_second(moves, undisturbed)) + " moves a second at the median cost of a unit; in all " +
         grouped(static_cast<std::uint64_t>(moves)) + " moves, " + grouped(static_cast<std::uint64_t>(units)) +
         " units\n";
}

std::string tracing_text(const ProfileView& view) {
  const std::uint64_t cycles = view.profile.planning.cycle.count() + view.profile.driving.cycle.count();
  const double a_cycle =
      static_cast<double>(view.profile.events) / static_cast<double>(std::max<std::uint64_t>(1, cycles));
  const double cost_ns = a_cycle * view.event_cost_ns;
  return "\n" +
         labelled("tracing", format("%s events, %s lost; %.0f a cycle at %.1f ns: %.2f us, %.3f %% of the budget",
                                    grouped(view.profile.events).c_str(),
                                    view.events_lost == 0 ? "none" : grouped(view.events_lost).c_str(), a_cycle,
                                    view.event_cost_ns, cost_ns / 1e3, percent(cost_ns, number(view.period)))) +
         "\n";
}

}  // namespace

std::string profile_text(const ProfileView& view) {
  std::string text = cycles_text("while planning", view.profile.planning, view.period) +
                     cycles_text("without planning", view.profile.driving, view.period) + steps_text(view.profile);
  if (view.profile.wake_up.worst() > Duration::zero()) {  // simulated time wakes when it likes
    text +=
        title("wake-up", view.profile.wake_up.count(), "cycles") + "\n" + row("latency", view.profile.wake_up) + "\n";
  }
  if (view.profile.skipped > 0) {
    text += "\n" +
            labelled("overruns", grouped(static_cast<std::uint64_t>(view.profile.skipped)) + " periods skipped") + "\n";
  }
  return text + tracing_text(view);
}

}  // namespace ivo::firmware
