#include "firmware/tools/doctor/privilege_checks.hpp"

#include "firmware/tools/doctor/memory_checks.hpp"
#include "firmware/tools/doctor/process_limits.hpp"
#include "tests/unit/firmware/tools/doctor/machine_folder.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::string_view kLimits = "/proc/self/limits";
constexpr std::string_view kStatus = "/proc/self/status";
constexpr std::string_view kNoCapabilities = "Name:\tivo\nCapEff:\t0000000000000000\n";
constexpr std::string_view kSysNice = "CapEff:\t0000000000800000\n";
constexpr std::string_view kIpcLock = "CapEff:\t0000000000004000\n";

std::string limits(const std::string& locked, const std::string& priority) {
  return "Limit                     Soft Limit           Hard Limit           Units     \n"
         "Max locked memory         " +
         locked + "              unlimited            bytes     \nMax realtime priority     " + priority +
         "                   99                   \n";
}

MachineFolder pc_with_privileges() {
  return {{kLimits, limits("unlimited", "90")},
          {kStatus, kNoCapabilities},
          {"/proc/sys/kernel/sched_rt_runtime_us", "950000\n"},
          {"/proc/sys/kernel/sched_rt_period_us", "1000000\n"},
          {"/proc/meminfo", "MemTotal:        8000000 kB\nMemAvailable:    1048576 kB\n"},
          {"/proc/swaps", "Filename\t\t\t\tType\t\tSize\n"}};
}

TEST(PrivilegeChecks, APriorityThatWasGrantedIsWell) {
  const MachineFolder machine = pc_with_privileges();
  const Group group = privilege_checks(machine.files(), {.priority = 80});
  expect_remedies(group);
  EXPECT_EQ(of(group, "real-time priority").state, State::kOk);
  EXPECT_EQ(of(group, "real-time priority").found, "SCHED_FIFO 80 is granted: RLIMIT_RTPRIO 90, no CAP_SYS_NICE");
  EXPECT_EQ(of(group, "real-time share").state, State::kOk);
}

TEST(PrivilegeChecks, OneThatWasRefusedIsAFaultWhateverTheLimitsSay) {
  MachineFolder machine = pc_with_privileges();
  const PriorityTrial refused{.priority = 80,
                              .refusal = "SCHED_FIFO priority 80 is not granted: Operation not permitted"};
  const Finding by_limit = of(privilege_checks(machine.files(), refused), "real-time priority");
  EXPECT_EQ(by_limit.state, State::kFault);
  EXPECT_NE(by_limit.remedy.find("\"ivo - rtprio 80\" in /etc/security/limits.d/ivo.conf"), std::string::npos);
  machine.put(kStatus, kSysNice);
  const Finding by_group = of(privilege_checks(machine.files(), refused), "real-time priority");
  EXPECT_EQ(by_group.state, State::kFault);
  EXPECT_NE(by_group.remedy.find("container"), std::string::npos);
}

TEST(PrivilegeChecks, OneThatInterruptThreadsPrecedeIsWarnedOf) {
  const MachineFolder machine = pc_with_privileges();
  EXPECT_EQ(of(privilege_checks(machine.files(), {.priority = 50}), "real-time priority").state, State::kWarning);
  EXPECT_EQ(of(privilege_checks(machine.files(), {.priority = 51}), "real-time priority").state, State::kOk);
}

TEST(PrivilegeChecks, AShareThatIsTooSmallForTheLoopIsAFault) {
  MachineFolder machine = pc_with_privileges();
  machine.put("/proc/sys/kernel/sched_rt_runtime_us", "500000\n");
  EXPECT_EQ(of(privilege_checks(machine.files(), {}), "real-time share").state, State::kFault);
  machine.put("/proc/sys/kernel/sched_rt_runtime_us", "-1\n");
  EXPECT_EQ(of(privilege_checks(machine.files(), {}), "real-time share").state, State::kOk);
  machine.put("/proc/sys/kernel/sched_rt_period_us", "0\n");
  EXPECT_EQ(of(privilege_checks(machine.files(), {}), "real-time share").state, State::kNotChecked);
}

TEST(ProcessLimits, ReadsSoftLimitsAndCapabilities) {
  MachineFolder machine = pc_with_privileges();
  EXPECT_TRUE(limit_called("Max locked memory", machine.files())->unlimited);
  EXPECT_EQ(limit_called("Max realtime priority", machine.files())->value, 90U);
  EXPECT_FALSE(limit_called("Max patience", machine.files()));
  EXPECT_FALSE(has_capability(kCapSysNice, machine.files()));
  machine.put(kStatus, kSysNice);
  EXPECT_TRUE(has_capability(kCapSysNice, machine.files()));
  EXPECT_FALSE(has_capability(kCapIpcLock, machine.files()));
}

TEST(MemoryChecks, AnUnlimitedLockAndRoomAreWell) {
  const MachineFolder machine = pc_with_privileges();
  const Group group = memory_checks(machine.files(), 400 * kMiB);
  expect_remedies(group);
  for (const Finding& finding : group.findings) {
    EXPECT_EQ(finding.state, State::kOk) << finding.check;
  }
}

TEST(MemoryChecks, ALimitBelowTheControllersNeedIsAFaultUnlessItDoesNotCount) {
  MachineFolder machine = pc_with_privileges();
  machine.put(kLimits, limits("8388608", "90"));
  const Finding limited = of(memory_checks(machine.files(), 400 * kMiB), "memory lock limit");
  EXPECT_EQ(limited.state, State::kFault);
  EXPECT_EQ(limited.found, "8 MiB; expected at least 400 MiB");
  EXPECT_EQ(of(memory_checks(machine.files(), 8 * kMiB), "memory lock limit").state, State::kOk);
  machine.put(kStatus, kIpcLock);
  EXPECT_EQ(of(memory_checks(machine.files(), 400 * kMiB), "memory lock limit").state, State::kOk);
}

TEST(MemoryChecks, TooLittleFreeMemoryIsAFault) {
  const MachineFolder machine = pc_with_privileges();
  EXPECT_EQ(of(memory_checks(machine.files(), 1024 * kMiB), "free memory").state, State::kOk);
  EXPECT_EQ(of(memory_checks(machine.files(), 1025 * kMiB), "free memory").state, State::kFault);
}

TEST(MemoryChecks, SwapIsWarnedOfByItsDevices) {
  MachineFolder machine = pc_with_privileges();
  machine.put("/proc/swaps", "Filename Type Size\n/dev/sda2 partition 9\n/swapfile file 1\n");
  const Group group = memory_checks(machine.files(), kMiB);
  expect_remedies(group);
  EXPECT_EQ(of(group, "swap").state, State::kWarning);
  EXPECT_EQ(of(group, "swap").found.find("on /dev/sda2, /swapfile"), 0U);
}

TEST(MemoryChecks, WhatIsNotThereIsNotChecked) {
  const MachineFolder nothing;
  for (const Finding& finding : memory_checks(nothing.files(), kMiB).findings) {
    EXPECT_EQ(finding.state, State::kNotChecked) << finding.check;
  }
  EXPECT_EQ(of(privilege_checks(nothing.files(), {.priority = 80}), "real-time share").state, State::kNotChecked);
  EXPECT_EQ(of(privilege_checks(nothing.files(), {.priority = 80}), "real-time priority").state, State::kOk);
}

}  // namespace
}  // namespace ivo::firmware::doctor
