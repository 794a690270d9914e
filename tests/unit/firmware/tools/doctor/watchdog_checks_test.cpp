#include "firmware/tools/doctor/watchdog_checks.hpp"

#include "tests/unit/firmware/tools/doctor/machine_folder.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::string_view kMain = "/etc/systemd/system.conf";
constexpr std::string_view kTimeout = "/sys/class/watchdog/watchdog0/timeout";

MachineFolder pc_with_watchdog() {
  return {{"/sys/class/watchdog/watchdog0/identity", "iTCO_wdt\n"},
          {"/sys/class/watchdog/watchdog0/state", "active\n"},
          {kTimeout, "10\n"},
          {"/dev/watchdog0", ""},
          {kMain, "[Manager]\n#RuntimeWatchdogSec=off\nRuntimeWatchdogSec=10\n"}};
}

TEST(WatchdogChecks, ADeviceThatSystemdFeedsIsWell) {
  const MachineFolder machine = pc_with_watchdog();
  const Group group = watchdog_checks(machine.files());
  expect_remedies(group);
  for (const Finding& finding : group.findings) {
    EXPECT_EQ(finding.state, State::kOk) << finding.check << ": " << finding.found;
  }
  EXPECT_EQ(of(group, "time-out").found, "10 s, running");
}

TEST(WatchdogChecks, NoDeviceIsWarnedOf) {
  MachineFolder machine = pc_with_watchdog();
  machine.remove("/sys/class/watchdog");
  const Group group = watchdog_checks(machine.files());
  expect_remedies(group);
  EXPECT_EQ(of(group, "device").state, State::kWarning);
  EXPECT_EQ(of(group, "time-out").state, State::kNotChecked);
}

TEST(WatchdogChecks, ASoftwareOneHangsWithItsKernel) {
  MachineFolder machine = pc_with_watchdog();
  machine.put("/sys/class/watchdog/watchdog0/identity", "Software Watchdog\n");
  EXPECT_EQ(of(watchdog_checks(machine.files()), "device").state, State::kWarning);
}

TEST(WatchdogChecks, ADriverWithoutADeviceFileIsAFault) {
  MachineFolder machine = pc_with_watchdog();
  machine.remove("/dev/watchdog0");
  EXPECT_EQ(of(watchdog_checks(machine.files()), "device").state, State::kFault);
}

TEST(WatchdogChecks, OneThatNobodyFeedsOrThatWaitsLongIsWarnedOf) {
  MachineFolder machine = pc_with_watchdog();
  machine.put(kMain, "[Manager]\n#RuntimeWatchdogSec=off\n");
  machine.put("/sys/class/watchdog/watchdog0/state", "inactive\n");
  EXPECT_EQ(of(watchdog_checks(machine.files()), "systemd feeds it").found, "RuntimeWatchdogSec is not set");
  EXPECT_EQ(of(watchdog_checks(machine.files()), "systemd feeds it").state, State::kWarning);
  EXPECT_EQ(of(watchdog_checks(machine.files()), "time-out").state, State::kWarning);
  machine.put(kMain, "[Manager]\nRuntimeWatchdogSec=10min\n");
  machine.put("/sys/class/watchdog/watchdog0/state", "active\n");
  machine.put(kTimeout, "600\n");
  const Group group = watchdog_checks(machine.files());
  expect_remedies(group);
  EXPECT_EQ(of(group, "systemd feeds it").state, State::kWarning);
  EXPECT_EQ(of(group, "time-out").state, State::kWarning);
}

TEST(WatchdogChecks, TheLastFileThatSetsItCounts) {
  MachineFolder machine = pc_with_watchdog();
  machine.put("/usr/lib/systemd/system.conf.d/20-vendor.conf", "[Manager]\nRuntimeWatchdogSec=20\n");
  EXPECT_EQ(runtime_watchdog(machine.files()), "20");
  machine.put("/etc/systemd/system.conf.d/10-ivo.conf", "[Manager]\nRuntimeWatchdogSec=15\n");
  EXPECT_EQ(runtime_watchdog(machine.files()), "20") << "drop-ins count by name, not by folder";
  machine.put("/etc/systemd/system.conf.d/20-vendor.conf", "[Manager]\n");
  EXPECT_EQ(runtime_watchdog(machine.files()), "15") << "a file of /etc hides its namesake";
  machine.put("/etc/systemd/system.conf.d/99-note.txt", "RuntimeWatchdogSec=1\n");
  EXPECT_EQ(runtime_watchdog(machine.files()), "15");
}

TEST(WatchdogChecks, ReadsSpansAsSystemdDoes) {
  EXPECT_DOUBLE_EQ(span_s("30").value(), 30.0);
  EXPECT_DOUBLE_EQ(span_s("1min 30s").value(), 90.0);
  EXPECT_DOUBLE_EQ(span_s("1min30s").value(), 90.0);
  EXPECT_DOUBLE_EQ(span_s("500 ms").value(), 0.5);
  EXPECT_DOUBLE_EQ(span_s("2.5s").value(), 2.5);
  EXPECT_DOUBLE_EQ(span_s("off").value(), 0.0);
  for (const char* const broken : {"infinity", "default", "10 parsecs", "s", "ten"}) {
    EXPECT_FALSE(span_s(broken)) << broken;
  }
}

TEST(WatchdogChecks, AMachineWithoutSystemdIsNotJudgedByIt) {
  const MachineFolder nothing;
  const Group group = watchdog_checks(nothing.files());
  expect_remedies(group);
  EXPECT_EQ(of(group, "systemd feeds it").state, State::kNotChecked);
  EXPECT_EQ(of(group, "time-out").state, State::kNotChecked);
}

}  // namespace
}  // namespace ivo::firmware::doctor
