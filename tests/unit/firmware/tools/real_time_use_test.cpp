#include "firmware/tools/real_time_use.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace ivo::firmware {
namespace {

using testing::ExitedWithCode;

constexpr uid_t kNobody = 65534;

// Ends a child of the test with 0 when `holds`: it has given up its privileges, which nobody gets back.
void end_child(bool holds, const std::string& what) {
  if (!holds) {
    (void)fprintf(stderr, "%s\n", what.c_str());
  }
  std::_Exit(holds ? 0 : 1);
}

void give_up_privileges() {
  const rlimit none{0, 0};
  (void)setrlimit(RLIMIT_RTPRIO, &none);
  (void)setrlimit(RLIMIT_MEMLOCK, &none);
  if (geteuid() == 0 && setuid(kNobody) != 0) {
    std::_Exit(2);
  }
}

TEST(RealTimeUse, ARobotIsNotDrivenWithoutTheRightToRealTime) {
  EXPECT_EXIT(
      {
        give_up_privileges();
        const Result<RealTimeUse> use = real_time_use(RunWorld::Time::kReal, {.priority = 80}, false);
        const std::string said = use ? "granted" : use.error().message;
        end_child(said.find("SCHED_FIFO priority 80") != std::string::npos &&
                      said.find("RLIMIT_RTPRIO is 0") != std::string::npos &&
                      said.find("--no-real-time") != std::string::npos,
                  said);
      },
      ExitedWithCode(0), "");
}

TEST(RealTimeUse, TheDegradedModeIsAskedForAndShown) {
  EXPECT_EXIT(
      {
        give_up_privileges();
        const Result<RealTimeUse> use = real_time_use(RunWorld::Time::kReal, {}, true);
        end_child(use && !use.value().place && use.value().text.find("NOT IN REAL TIME") != std::string::npos,
                  use ? use.value().text : use.error().message);
      },
      ExitedWithCode(0), "");
}

TEST(RealTimeUse, ASimulatedBusNeedsNoPrivilegesAndSaysHowItRuns) {
  EXPECT_EXIT(
      {
        give_up_privileges();
        const Result<RealTimeUse> use = real_time_use(RunWorld::Time::kRealOnSimulatedBus, {}, false);
        end_child(use && !use.value().place && use.value().text.find("ordinary scheduling") != std::string::npos,
                  use ? use.value().text : use.error().message);
      },
      ExitedWithCode(0), "");
}

TEST(RealTimeUse, SimulatedTimeAsksForNothing) {
  const Result<RealTimeUse> use = real_time_use(RunWorld::Time::kSimulated, {}, false);
  ASSERT_TRUE(use);
  EXPECT_FALSE(use.value().place);
  EXPECT_TRUE(use.value().text.empty());
}

}  // namespace
}  // namespace ivo::firmware
