#include "firmware/tools/doctor/processor_checks.hpp"

#include "firmware/tools/doctor/cpu_list.hpp"
#include "firmware/tools/doctor/kernel_command_line.hpp"
#include "tests/unit/firmware/tools/doctor/machine_folder.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::string_view kCmdline = "/proc/cmdline";
constexpr std::string_view kIsolated = "/sys/devices/system/cpu/isolated";
constexpr std::string_view kGovernor = "/sys/devices/system/cpu/cpu3/cpufreq/scaling_governor";

// Four CPUs, the last of them the loop's.
MachineFolder pc_with_processors() {
  return {{kCmdline, "BOOT_IMAGE=/vmlinuz quiet isolcpus=managed_irq,domain,3 nohz_full=3 rcu_nocbs=3\n"},
          {"/sys/devices/system/cpu/online", "0-3\n"},
          {kIsolated, "3\n"},
          {"/sys/devices/system/cpu/nohz_full", "3\n"},
          {kGovernor, "performance\n"},
          {"/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n"},
          {"/sys/devices/system/cpu/cpuidle/current_driver", "intel_idle\n"},
          {"/sys/devices/system/cpu/cpu3/cpuidle/state0/name", "POLL\n"},
          {"/sys/devices/system/cpu/cpu3/cpuidle/state0/latency", "0\n"},
          {"/sys/devices/system/cpu/cpu3/cpuidle/state1/name", "C1E\n"},
          {"/sys/devices/system/cpu/cpu3/cpuidle/state1/latency", "10\n"},
          {"/proc/irq/default_smp_affinity", "7\n"},
          {"/proc/irq/9/effective_affinity_list", "0\n"},
          {"/proc/irq/9/acpi/x", ""},
          {"/proc/irq/11/effective_affinity_list", "3\n"}};  // whom nobody handles
}

LoopCpu bound_to(int cpu) { return {.bound = cpu, .examined = cpu, .robot_file = "robot.toml"}; }
const LoopCpu kUnbound{.bound = {}, .examined = {}, .robot_file = "robot.toml"};

void expect_all_ok(const Group& group) {
  for (const Finding& finding : group.findings) {
    EXPECT_EQ(finding.state, State::kOk) << finding.check << ": " << finding.found;
  }
}

TEST(ProcessorChecks, ACpuOfItsOwnIsWell) {
  const MachineFolder machine = pc_with_processors();
  const Group group = processor_checks(machine.files(), bound_to(3));
  expect_remedies(group);
  expect_all_ok(group);
  EXPECT_EQ(group.findings.size(), 7U);
}

TEST(ProcessorChecks, AnIsolatedCpuThatTheLoopIsNotBoundToIsNotTheLoops) {
  const MachineFolder machine = pc_with_processors();
  const Group group = processor_checks(machine.files(), kUnbound);
  expect_remedies(group);
  EXPECT_EQ(of(group, "loop's CPU").state, State::kWarning);
  EXPECT_EQ(of(group, "loop's CPU").found, "CPU 3 is isolated, but the loop is not bound to it");
  EXPECT_EQ(of(group, "loop's CPU").remedy, "cpu = 3 under [loop] in robot.toml");
  for (const Finding& finding : group.findings) {
    EXPECT_NE(finding.check, "isolation") << "of a CPU that the loop will not have";
  }
}

TEST(ProcessorChecks, ACpuThatWasAskedAboutIsLookedAtAndTheLoopMissedThere) {
  const MachineFolder machine = pc_with_processors();
  for (const std::optional<int> bound : {std::optional<int>(), std::optional<int>(1)}) {
    const Group group = processor_checks(machine.files(), {.bound = bound, .examined = 3, .robot_file = "robot.toml"});
    expect_remedies(group);
    EXPECT_EQ(of(group, "loop's CPU").state, State::kWarning);
    EXPECT_EQ(of(group, "loop's CPU").remedy, "cpu = 3 under [loop] in robot.toml");
    EXPECT_EQ(of(group, "isolation").state, State::kOk);
  }
}

TEST(ProcessorChecks, ACpuThatOthersShareIsWarnedOfWithTheWholeCommandLine) {
  const MachineFolder machine = pc_with_processors();
  const Group group = processor_checks(machine.files(), bound_to(2));
  expect_remedies(group);
  for (const char* const check : {"isolation", "timer tick", "RCU callbacks"}) {
    EXPECT_EQ(of(group, check).state, State::kWarning) << check;
    EXPECT_NE(of(group, check).remedy.find("isolcpus=2 nohz_full=2 rcu_nocbs=2"), std::string::npos) << check;
  }
}

TEST(ProcessorChecks, TheTicklessHaveTheirCallbacksElsewhereToo) {
  MachineFolder machine = pc_with_processors();
  machine.put(kCmdline, "nohz_full=2-3");
  EXPECT_EQ(of(processor_checks(machine.files(), bound_to(3)), "RCU callbacks").state, State::kOk);
  machine.put(kCmdline, "rcu_nocbs=all");
  EXPECT_EQ(of(processor_checks(machine.files(), bound_to(3)), "RCU callbacks").state, State::kOk);
  machine.put(kCmdline, "rcu_nocbs=0-2");
  EXPECT_EQ(of(processor_checks(machine.files(), bound_to(3)), "RCU callbacks").state, State::kWarning);
}

TEST(ProcessorChecks, ACpuThatIsNotThereIsAFault) {
  const MachineFolder machine = pc_with_processors();
  const Group group = processor_checks(machine.files(), bound_to(9));
  expect_remedies(group);
  EXPECT_EQ(of(group, "loop's CPU").state, State::kFault);
  EXPECT_EQ(of(group, "loop's CPU").found, "CPU 9 is not there; there are 0-3");
}

TEST(ProcessorChecks, WithoutAnIsolatedCpuTheLastOneIsProposed) {
  MachineFolder machine = pc_with_processors();
  machine.put(kIsolated, "\n");
  const Group group = processor_checks(machine.files(), kUnbound);
  EXPECT_EQ(of(group, "isolation").state, State::kWarning);
  EXPECT_EQ(of(group, "isolation").remedy,
            "add isolcpus=3 nohz_full=3 rcu_nocbs=3 to the kernel's command line where the boot loader has it, then "
            "reboot; with cpu = 3 under [loop] in robot.toml");
}

TEST(ProcessorChecks, ALoopBesideTheIsolatedCpuIsSentThere) {
  const MachineFolder machine = pc_with_processors();
  const Finding found = of(processor_checks(machine.files(), bound_to(2)), "isolation");
  EXPECT_EQ(found.remedy.find("cpu = 3 under [loop] in robot.toml; or add isolcpus=2 "), 0U) << found.remedy;
}

TEST(KernelCommandLine, EachRemedyAddsToWhatTheOthersAdd) {
  MachineFolder machine = pc_with_processors();
  machine.put("/etc/default/grub", "GRUB_CMDLINE_LINUX=\"\"\n");
  machine.put("/proc/irq/20/smp_affinity_list", "0-3\n");
  machine.put("/proc/irq/20/eth20/x", "");
  machine.put("/sys/devices/system/cpu/cpu2/cpuidle/state2/latency", "133\n");
  const Group group = processor_checks(machine.files(), bound_to(2));
  for (const char* const check : {"isolation", "timer tick", "RCU callbacks", "interrupts", "idle states"}) {
    const std::string remedy = of(group, check).remedy;
    EXPECT_NE(remedy.find("add "), std::string::npos) << remedy;
    EXPECT_NE(remedy.find(" to GRUB_CMDLINE_LINUX in /etc/default/grub, then update-grub and reboot"),
              std::string::npos)
        << remedy;
    EXPECT_EQ(remedy.find("GRUB_CMDLINE_LINUX="), std::string::npos) << "it would put the others' out";
  }
}

TEST(KernelCommandLine, TheLastOfAnArgumentCounts) {
  MachineFolder machine = pc_with_processors();
  machine.put(kCmdline, "isolcpus=1 quiet isolcpus=2");
  EXPECT_EQ(kernel_argument(machine.files(), "isolcpus"), "2");
  EXPECT_EQ(kernel_argument(machine.files(), "nohz_full"), "");
}

TEST(ProcessorChecks, OneCpuCannotBeSetApart) {
  MachineFolder machine = pc_with_processors();
  machine.put("/sys/devices/system/cpu/online", "0\n");
  EXPECT_EQ(of(processor_checks(machine.files(), bound_to(0)), "isolation").state, State::kNotChecked);
}

TEST(ProcessorChecks, AGovernorThatSavesPowerIsNamedWithItsCpus) {
  MachineFolder machine = pc_with_processors();
  machine.put(kGovernor, "schedutil\n");
  const Finding one = of(processor_checks(machine.files(), bound_to(3)), "frequency governor");
  EXPECT_EQ(one.state, State::kWarning);
  EXPECT_EQ(one.found, "schedutil (CPU 3); expected performance");
  EXPECT_NE(one.remedy.find("cpupower -c 3 frequency-set -g performance"), std::string::npos);
  machine.put(kIsolated, "\n");
  const Finding all = of(processor_checks(machine.files(), kUnbound), "frequency governor");
  EXPECT_EQ(all.found, "powersave (CPU 0), schedutil (CPU 3); expected performance");
}

TEST(ProcessorChecks, ADeepSleepIsWarnedOfUnlessItIsDisabledOrHeldOff) {
  MachineFolder machine = pc_with_processors();
  machine.put("/sys/devices/system/cpu/cpu3/cpuidle/state2/name", "C6\n");
  machine.put("/sys/devices/system/cpu/cpu3/cpuidle/state2/latency", "133\n");
  machine.put("/sys/devices/system/cpu/cpu3/cpuidle/state2/disable", "0\n");
  machine.put("/dev/cpu_dma_latency", std::string_view("\x00\x94\x35\x77", 4));  // 2,000 s: nobody asks for less
  EXPECT_EQ(of(processor_checks(machine.files(), bound_to(3)), "idle states").state, State::kWarning);
  EXPECT_EQ(of(processor_checks(machine.files(), bound_to(3)), "idle states").found,
            "C6 takes 133 us to leave; expected at most 50");
  machine.put("/dev/cpu_dma_latency", std::string_view("\x0A\x00\x00\x00", 4));  // 10 us, white space
  EXPECT_EQ(of(processor_checks(machine.files(), bound_to(3)), "idle states").state, State::kOk);
  machine.remove("/dev/cpu_dma_latency");
  machine.put("/sys/devices/system/cpu/cpu3/cpuidle/state2/disable", "1\n");
  EXPECT_EQ(of(processor_checks(machine.files(), bound_to(3)), "idle states").state, State::kOk);
}

TEST(ProcessorChecks, InterruptsOnTheLoopsCpuAreCountedAndNamed) {
  MachineFolder machine = pc_with_processors();
  for (const char* const irq : {"20", "21", "22", "23"}) {
    machine.put(std::string("/proc/irq/") + irq + "/smp_affinity_list", "0-3\n");
    machine.put(std::string("/proc/irq/") + irq + "/eth" + irq + "/x", "");
  }
  machine.put("/proc/irq/23/effective_affinity_list", "1\n");  // where it may run is not where it runs
  const Finding found = of(processor_checks(machine.files(), bound_to(3)), "interrupts");
  EXPECT_EQ(found.state, State::kWarning);
  EXPECT_EQ(found.found, "3 of 5 on CPU 3: 20 (eth20), 21 (eth21), 22 (eth22)");
  EXPECT_NE(found.remedy.find("irqaffinity=0-2"), std::string::npos);
}

TEST(ProcessorChecks, WhatIsNotThereIsNotChecked) {
  const MachineFolder nothing;
  for (const std::optional<int> cpu : {std::optional<int>(), std::optional<int>(1)}) {
    const Group group = processor_checks(nothing.files(), cpu ? bound_to(*cpu) : kUnbound);
    EXPECT_GE(group.findings.size(), 3U);
    for (const Finding& finding : group.findings) {
      EXPECT_EQ(finding.state, State::kNotChecked) << finding.check;
    }
  }
}

TEST(CpuList, ReadsAndWritesTheKernelsLists) {
  EXPECT_EQ(cpus_in("0-3,5"), (std::vector<int>{0, 1, 2, 3, 5}));
  EXPECT_EQ(cpus_in("managed_irq,domain,2"), (std::vector<int>{2}));
  EXPECT_EQ(cpus_in("3,1-2,2"), (std::vector<int>{1, 2, 3}));
  for (const char* const broken : {"", "(null)", "-", "1-", "3-1", "-2", "9999999", "0-9999999", "1.5"}) {
    EXPECT_TRUE(cpus_in(broken).empty()) << broken;
  }
  EXPECT_EQ(list_text({0, 1, 2, 3, 5, 7, 8}), "0-3,5,7-8");
  EXPECT_EQ(list_text(without({0, 1, 2}, 1)), "0,2");
}

}  // namespace
}  // namespace ivo::firmware::doctor
