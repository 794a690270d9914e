#include "firmware/tools/doctor/latency_figures.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::size_t kMostBins = 20;
constexpr std::int64_t kLastEdge_us = 1'000'000'000;

std::int64_t whole_us(Duration time) { return std::chrono::duration_cast<std::chrono::microseconds>(time).count(); }
unsigned long long number(std::uint64_t value) { return value; }

/// 0, then each of `steps` (in tenths, from 10 to below 100) in each decade, where it is a whole number.
std::vector<std::int64_t> edges(std::span<const int> steps) {
  std::vector<std::int64_t> all{0};
  for (std::int64_t decade = 1; decade < kLastEdge_us; decade *= 10) {
    for (const int step : steps) {
      if (decade * step % 10 == 0) {
        all.push_back(decade * step / 10);
      }
    }
  }
  return all;
}

std::vector<Bin> binned(std::span<const Duration> sorted, const std::vector<std::int64_t>& all) {
  const auto bin_of = [&](Duration late) {
    const auto next = std::upper_bound(all.begin() + 1, all.end() - 1, whole_us(late));
    return static_cast<std::size_t>(next - all.begin()) - 1;
  };
  const std::size_t first = bin_of(sorted.front());
  std::vector<Bin> bins;
  for (std::size_t i = first; i <= bin_of(sorted.back()); ++i) {
    bins.push_back({all[i], all[i + 1], 0});
  }
  for (const Duration late : sorted) {
    ++bins[bin_of(late) - first].count;
  }
  return bins;
}

std::string remedy_of_lateness(const LatencyRun& run) {
  return run.real_time
             ? "what is wrong above; then `hwlatdetect` (apt install rt-tests) for the firmware's share, and `ps "
               "-eLo rtprio,psr,comm --sort=-rtprio | head` for other real-time threads"
             : "the remedy of real-time priority above, then again";
}

}  // namespace

Duration percentile(std::span<const Duration> sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

LatencyFigures figures_of(const LatencyRun& run) {
  LatencyFigures figures;
  figures.least = run.late.front();
  figures.median = percentile(run.late, 0.5);
  figures.p99 = percentile(run.late, 0.99);
  figures.p999 = percentile(run.late, 0.999);
  figures.most = run.late.back();
  figures.budget = wake_up_budget(run.period);
  figures.over_budget = static_cast<std::uint64_t>(run.late.end() - std::ranges::upper_bound(run.late, figures.budget));
  return figures;
}

std::vector<Bin> histogram_of(std::span<const Duration> sorted) {
  constexpr std::array kFine{10, 12, 15, 20, 25, 30, 40, 50, 60, 80};
  constexpr std::array kCoarse{10, 20, 50};
  std::vector<Bin> bins = binned(sorted, edges(kFine));
  return bins.size() <= kMostBins ? bins : binned(sorted, edges(kCoarse));
}

std::string thread_text(const LatencyRun& run) {
  return (run.real_time ? format("a SCHED_FIFO thread, priority %d", run.place.priority)
                        : std::string("an ordinary thread, for SCHED_FIFO was refused")) +
         (run.real_time && run.place.cpu ? format(", on CPU %d", *run.place.cpu) : "") +
         (run.locked ? ", with locked memory" : ", without locked memory");
}

Group latency_checks(const LatencyRun& run) {
  const LatencyFigures figures = figures_of(run);
  Group group{"Latency", {}};
  const std::string who =
      format("%s, ", counted(static_cast<int>(run.late.size()), "wake-up").c_str()) + thread_text(run);
  group.findings.push_back(run.real_time
                               ? ok("measured", who)
                               : warning("measured", who, "the remedy of real-time priority above, then again"));
  const std::string spread = format("least %.1f, median %.1f, p99 %.1f, p99.9 %.1f, most %.1f us",
                                    microseconds(figures.least), microseconds(figures.median),
                                    microseconds(figures.p99), microseconds(figures.p999), microseconds(figures.most));
  group.findings.push_back(figures.most < run.period ? ok("late by", spread)
                                                     : fault("late by", spread, remedy_of_lateness(run)));
  const std::string late = format("%llu later than the budget of %.0f us, a tenth of the cycle; %llu periods lost",
                                  number(figures.over_budget), microseconds(figures.budget), number(run.lost_periods));
  group.findings.push_back(figures.over_budget == 0 ? ok("too late", late)
                                                    : warning("too late", late, remedy_of_lateness(run)));
  const std::string faults = format("%llu while it ran", number(run.faults.minor + run.faults.major));
  group.findings.push_back(run.faults.minor + run.faults.major == 0 ? ok("page faults", faults)
                                                                    : warning("page faults", faults + "; expected none",
                                                                              "the remedy of memory lock limit above"));
  return group;
}

std::vector<std::string> histogram_lines(const LatencyRun& run) {
  constexpr double kLongest = 40.0;
  const std::vector<Bin> bins = histogram_of(run.late);
  const std::int64_t budget_us = whole_us(wake_up_budget(run.period));
  std::uint64_t most = 1;
  for (const Bin& bin : bins) {
    most = std::max(most, bin.count);
  }
  std::vector<std::string> lines;
  for (const Bin& bin : bins) {
    const double share = bin.count == 0 ? 0.0
                                        : (1.0 + std::log10(static_cast<double>(bin.count))) /
                                              (1.0 + std::log10(static_cast<double>(most)));
    const std::string stripe(static_cast<std::size_t>(std::lround(kLongest * share)),
                             bin.from_us >= budget_us ? '!' : '#');
    lines.push_back(format("%8lld %8lld %10llu  ", static_cast<long long>(bin.from_us),
                           static_cast<long long>(bin.to_us), number(bin.count)) +
                    stripe);
  }
  return lines;
}

}  // namespace ivo::firmware::doctor
