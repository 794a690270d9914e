#include "firmware/tools/doctor/kernel_checks.hpp"

#include "tests/unit/firmware/tools/doctor/machine_folder.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::string_view kVersion = "/proc/sys/kernel/version";
constexpr std::string_view kSource = "/sys/devices/system/clocksource/clocksource0/current_clocksource";

MachineFolder pc_with_kernel() {
  return {{"/sys/kernel/realtime", "1\n"},
          {"/proc/sys/kernel/osrelease", "6.1.0-30-rt-amd64\n"},
          {kVersion, "#1 SMP PREEMPT_RT Debian 6.1.124-1 (2025-01-12)\n"},
          {"/proc/cpuinfo", "processor\t: 0\nmodel name\t: A CPU of 3 GHz\nflags\t\t: fpu tsc avx2\n"},
          {kSource, "tsc\n"}};
}

TEST(KernelChecks, ARealTimeKernelOnHardwareIsWell) {
  const MachineFolder machine = pc_with_kernel();
  const Group group = kernel_checks(machine.files());
  expect_remedies(group);
  EXPECT_EQ(of(group, "real-time kernel").state, State::kOk);
  EXPECT_EQ(of(group, "real-time kernel").found, "PREEMPT_RT, 6.1.0-30-rt-amd64");
  EXPECT_EQ(of(group, "hardware").state, State::kOk);
  EXPECT_EQ(of(group, "hardware").found, "A CPU of 3 GHz");
  EXPECT_EQ(of(group, "clock source").state, State::kOk);
}

TEST(KernelChecks, ANewerKernelSaysItInItsVersionAlone) {
  MachineFolder machine = pc_with_kernel();
  machine.remove("/sys/kernel/realtime");
  EXPECT_EQ(of(kernel_checks(machine.files()), "real-time kernel").state, State::kOk);
}

TEST(KernelChecks, AnOrdinaryKernelIsAFaultWithThePackageThatMendsIt) {
  MachineFolder machine = pc_with_kernel();
  machine.remove("/sys/kernel/realtime");
  machine.put(kVersion, "#1 SMP PREEMPT_DYNAMIC Debian 6.1.124-1 (2025-01-12)\n");
  const Group group = kernel_checks(machine.files());
  expect_remedies(group);
  EXPECT_EQ(of(group, "real-time kernel").state, State::kFault);
  EXPECT_EQ(of(group, "real-time kernel").found, "6.1.0-30-rt-amd64, PREEMPT_DYNAMIC; expected PREEMPT_RT");
  EXPECT_NE(of(group, "real-time kernel").remedy.find("linux-image-rt-amd64"), std::string::npos);
}

TEST(KernelChecks, AGuestIsNoRobotsPc) {
  MachineFolder machine = pc_with_kernel();
  machine.put("/proc/cpuinfo", "flags\t\t: fpu hypervisor\n");
  EXPECT_EQ(of(kernel_checks(machine.files()), "hardware").state, State::kWarning);
}

TEST(KernelChecks, AClockThatIsSlowToReadIsWarnedOf) {
  MachineFolder machine = pc_with_kernel();
  for (const char* const source : {"hpet", "acpi_pm", "jiffies"}) {
    machine.put(kSource, source);
    EXPECT_EQ(of(kernel_checks(machine.files()), "clock source").state, State::kWarning) << source;
  }
  machine.put(kSource, "arch_sys_counter\n");
  EXPECT_EQ(of(kernel_checks(machine.files()), "clock source").state, State::kOk);
}

TEST(KernelChecks, WhatIsNotThereIsNotChecked) {
  const MachineFolder nothing;
  for (const Finding& finding : kernel_checks(nothing.files()).findings) {
    EXPECT_EQ(finding.state, State::kNotChecked) << finding.check;
    EXPECT_NE(finding.found.find("is not there"), std::string::npos) << finding.found;
  }
}

}  // namespace
}  // namespace ivo::firmware::doctor
