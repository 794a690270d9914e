#include <numeric>

#include "firmware/tools/doctor/doctor_document.hpp"
#include "firmware/tools/doctor/latency_figures.hpp"
#include "firmware/tools/doctor/report_text.hpp"
#include "tests/unit/firmware/tools/doctor/machine_folder.hpp"

namespace ivo::firmware::doctor {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""us;

LatencyRun run_of(std::vector<Duration> late) {
  LatencyRun run;
  run.period = 2ms;
  run.late = std::move(late);
  run.real_time = true;
  run.locked = true;
  return run;
}

/// 1 to 1000 us, one each.
std::vector<Duration> thousand() {
  std::vector<Duration> late;
  for (int i = 1; i <= 1000; ++i) {
    late.push_back(i * 1us);
  }
  return late;
}

Group checked(const LatencyRun& run) {
  Group group = latency_checks(run);
  expect_remedies(group);
  return group;
}

TEST(LatencyFigures, PercentilesAreValuesThatWereMeasured) {
  const LatencyFigures figures = figures_of(run_of(thousand()));
  EXPECT_EQ(figures.least, 1us);
  EXPECT_EQ(figures.median, 500us);
  EXPECT_EQ(figures.p99, 990us);
  EXPECT_EQ(figures.p999, 999us);
  EXPECT_EQ(figures.most, 1000us);
  EXPECT_EQ(percentile(std::vector<Duration>{7us}, 0.999), 7us);
}

TEST(LatencyFigures, LaterThanTheBudgetIsWhatIsLaterAndNotWhatIsEqual) {
  const LatencyFigures figures = figures_of(run_of(thousand()));
  EXPECT_EQ(figures.budget, 200us);
  EXPECT_EQ(figures.over_budget, 800U);
}

TEST(LatencyFigures, TheHistogramHoldsEveryWakeUpOnceInBinsThatTouch) {
  for (const std::vector<Duration>& late : {thousand(), std::vector<Duration>{0us},
                                            std::vector<Duration>{9us, 10us, 11us}, std::vector<Duration>{1us, 17ms}}) {
    const std::vector<Bin> bins = histogram_of(late);
    EXPECT_LE(bins.size(), 24U);
    const std::uint64_t sum = std::accumulate(bins.begin(), bins.end(), std::uint64_t{0},
                                              [](std::uint64_t all, const Bin& bin) { return all + bin.count; });
    EXPECT_EQ(sum, late.size());
    EXPECT_GT(bins.front().count, 0U);
    EXPECT_GT(bins.back().count, 0U);
    for (std::size_t i = 1; i < bins.size(); ++i) {
      EXPECT_EQ(bins[i].from_us, bins[i - 1].to_us);
    }
    EXPECT_LE(bins.front().from_us * 1us, late.front());
    EXPECT_GT(bins.back().to_us * 1us, late.back());
  }
}

TEST(LatencyFigures, AWakeUpOfHoursIsInTheLastBin) {
  const std::vector<Bin> bins = histogram_of(std::vector<Duration>{std::chrono::hours(5)});
  ASSERT_EQ(bins.size(), 1U);
  EXPECT_EQ(bins[0].count, 1U);
}

TEST(LatencyChecks, WakeUpsInTimeAreWell) {
  for (const Finding& finding : checked(run_of({5us, 6us, 200us})).findings) {
    EXPECT_EQ(finding.state, State::kOk) << finding.check;
  }
}

TEST(LatencyChecks, LaterThanTheBudgetIsWarnedOfAndAWholeCycleIsAFault) {
  const Group late = checked(run_of({5us, 6us, 201us}));
  EXPECT_EQ(of(late, "late by").state, State::kOk);
  EXPECT_EQ(of(late, "too late").state, State::kWarning);
  EXPECT_EQ(of(late, "too late").found, "1 later than the budget of 200 us, a tenth of the cycle; 0 periods lost");
  EXPECT_EQ(of(checked(run_of({5us, 2ms})), "late by").state, State::kFault);
}

TEST(LatencyChecks, AnOrdinaryThreadIsSaidToBeOne) {
  LatencyRun run = run_of({5us});
  run.real_time = false;
  run.locked = false;
  const Finding found = of(checked(run), "measured");
  EXPECT_EQ(found.state, State::kWarning);
  EXPECT_EQ(found.found, "1 wake-up, an ordinary thread, for SCHED_FIFO was refused, without locked memory");
}

TEST(LatencyChecks, PageFaultsAreWarnedOf) {
  LatencyRun run = run_of({5us});
  run.faults.minor = 2;
  EXPECT_EQ(of(checked(run), "page faults").state, State::kWarning);
}

TEST(LatencyTrial, WakesUpAsOftenAsThereIsTimeForAndCountsTheRestAsLost) {
  const LatencyRun run = try_latency({.period = 1ms, .length = 50ms, .place = {}, .lock_memory = false});
  ASSERT_FALSE(run.late.empty());
  EXPECT_LE(run.late.size(), 50U);
  EXPECT_GE(run.late.front(), 0us);
  EXPECT_TRUE(std::ranges::is_sorted(run.late));
  EXPECT_FALSE(run.locked);
  EXPECT_GE(run.late.size() + run.lost_periods, 49U);
}

TEST(ReportText, ShowsEachFindingWithItsRemedyBelow) {
  const Group group{"Kernel", {ok("clock source", "tsc"), fault("swap", "on", "`swapoff -a`")}};
  EXPECT_EQ(group_text(group, false),
            "Kernel\n"
            "  ok           clock source        tsc\n"
            "  fault        swap                on\n"
            "                                -> `swapoff -a`\n");
  EXPECT_EQ(group_text(group, false).find('\033'), std::string::npos);
  EXPECT_NE(group_text(group, true).find("\033[32mok"), std::string::npos);
}

TEST(ReportText, TheSumCountsEachState) {
  const std::vector<Group> groups{{"A", {ok("a", "x"), ok("b", "x"), warning("c", "x", "y")}},
                                  {"B", {fault("d", "x", "y"), not_checked("e", "x")}}};
  EXPECT_EQ(sum_text(sum_of(groups), false),
            "not fit for a robot yet: mend the faults first (2 ok, 1 warning, 1 fault, 1 not checked)\n");
}

TEST(ReportText, BarsGrowByDigitsAndMarkWhatIsTooLate) {
  std::vector<Duration> late(1000, 5us);
  late.push_back(300us);
  const std::string text = latency_text(run_of(late));
  EXPECT_NE(text.find(" 1000  " + std::string(40, '#') + "\n"), std::string::npos) << text;
  EXPECT_NE(text.find("    1  " + std::string(10, '!') + "\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace ivo::firmware::doctor
