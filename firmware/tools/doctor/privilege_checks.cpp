#include "firmware/tools/doctor/privilege_checks.hpp"

#include "firmware/tools/doctor/process_limits.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr int kInterruptThreads = 50;  // SCHED_FIFO priority that a PREEMPT_RT kernel gives them

std::string rights_text(const MachineFiles& files) {
  const std::optional<Limit> limit = limit_called("Max realtime priority", files);
  const std::string rtprio = !limit
                                 ? "RLIMIT_RTPRIO is not told"
                                 : "RLIMIT_RTPRIO " + (limit->unlimited ? "unlimited" : std::to_string(limit->value));
  return rtprio + (has_capability(kCapSysNice, files) ? ", CAP_SYS_NICE" : ", no CAP_SYS_NICE");
}

Finding real_time_priority(const MachineFiles& files, const PriorityTrial& trial) {
  const std::string check = "real-time priority";
  if (trial.refusal.empty() && trial.priority <= kInterruptThreads) {
    return warning(check,
                   format("SCHED_FIFO %d is granted; expected above %d, or every interrupt thread runs first",
                          trial.priority, kInterruptThreads),
                   "loop.priority = 80 in the robot file");
  }
  if (trial.refusal.empty()) {
    return ok(check, format("SCHED_FIFO %d is granted: ", trial.priority) + rights_text(files));
  }
  const std::string found = trial.refusal + " (" + rights_text(files) + ")";
  const bool entitled = has_capability(kCapSysNice, files);
  return fault(check, found,
               entitled
                   ? "a container or control group forbids it: start it with --ulimit rtprio=99 --cap-add "
                     "sys_nice, or run outside"
                   : format("\"ivo - rtprio %d\" in /etc/security/limits.d/ivo.conf (ivo: who runs it), then log in "
                            "anew; of a service LimitRTPRIO=%d",
                            trial.priority, trial.priority));
}

// The kernel keeps a part of each second for ordinary threads, so that a real-time one cannot freeze a machine. A loop
// that stays within its cycle never gets there.
Finding throttling(const MachineFiles& files) {
  constexpr double kLeastShare = 0.9;
  const std::string check = "real-time share";
  const std::string path = "/proc/sys/kernel/sched_rt_runtime_us";
  const std::optional<std::int64_t> runtime = files.number(path);
  const std::int64_t period = files.number("/proc/sys/kernel/sched_rt_period_us").value_or(1'000'000);
  if (!runtime || period <= 0) {
    return not_checked(check, absent(path));
  }
  if (*runtime < 0) {
    return ok(check, "all of a CPU: sched_rt_runtime_us is -1");
  }
  const double share = static_cast<double>(*runtime) / static_cast<double>(period);
  const std::string found = format("%.0f %% of a CPU (sched_rt_runtime_us %lld of %lld)", 100.0 * share,
                                   static_cast<long long>(*runtime), static_cast<long long>(period));
  return share >= kLeastShare ? ok(check, found)
                              : fault(check, found + "; expected at least 90 %",
                                      "`sysctl -w kernel.sched_rt_runtime_us=" + std::to_string(period / 20 * 19) +
                                          "`; to keep it, a line in /etc/sysctl.d/ivo.conf");
}

}  // namespace

Group privilege_checks(const MachineFiles& files, const PriorityTrial& trial) {
  return {"Privileges", {real_time_priority(files, trial), throttling(files)}};
}

}  // namespace ivo::firmware::doctor
