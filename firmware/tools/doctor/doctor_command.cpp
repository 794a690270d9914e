#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware/files/robot_file.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/tools/doctor/can_checks.hpp"
#include "firmware/tools/doctor/disk_checks.hpp"
#include "firmware/tools/doctor/doctor_document.hpp"
#include "firmware/tools/doctor/doctor_options.hpp"
#include "firmware/tools/doctor/drive_checks.hpp"
#include "firmware/tools/doctor/kernel_checks.hpp"
#include "firmware/tools/doctor/latency_figures.hpp"
#include "firmware/tools/doctor/memory_checks.hpp"
#include "firmware/tools/doctor/privilege_checks.hpp"
#include "firmware/tools/doctor/processor_checks.hpp"
#include "firmware/tools/doctor/report_text.hpp"
#include "firmware/tools/doctor/watchdog_checks.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/stop_signal.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/preflight.hpp"
#include "firmware/tools/wheels/wheels_world.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::uint64_t kNeededBytes = sizeof(planner::Planner) + kBytesBesidePlanner;

bool coloured() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) != 0 && kind != nullptr && std::string_view(kind) != "dumb" &&
         std::getenv("NO_COLOR") == nullptr;
}

/// One examination: what is known of machine and robot, and what was found so far, told as it is found.
class Examination {
 public:
  Examination(const Options& options, const Robot& robot) : options_(options), robot_(robot) {
    place_.priority = options.priority.value_or(robot.loop.priority);
    place_.cpu = options.cpu ? options.cpu : robot.loop.cpu;
  }

  void tell(Group group) {
    (void)std::printf("%s\n", group_text(group, coloured_).c_str());
    (void)std::fflush(stdout);
    groups_.push_back(std::move(group));
  }

  [[nodiscard]] Group privileges() const {
    const Result<void> entered = hal::may_enter_real_time({.priority = place_.priority, .cpu = {}});
    // After the semicolon stands what is expected, which the check says in its own way.
    return privilege_checks(
        files_, {.priority = place_.priority,
                 .refusal = entered ? "" : entered.error().message.substr(0, entered.error().message.find(';'))});
  }

  void bus() {
    const hal::LinkAnswer link = options_.can.empty() ? hal::LinkAnswer() : hal::ask_for_link(options_.can);
    tell(can_checks(options_.can, link, robot_));
    tell(options_.can.empty() ? Group{kDrives, {not_checked("answer", "no interface was named: --can can0")}}
         : usable(link, robot_)
             ? drives()
             : Group{kDrives, {not_checked("answer", options_.can + " cannot be used as it is: see above")}});
  }

  void latency() {
    const double length_s = options_.latency_s.value_or(kLatencyS);
    if (length_s <= 0.0) {
      tell({"Latency", {not_checked("late by", "left out: --latency 0")}});
      return;
    }
    if (coloured_) {
      (void)std::printf("measuring wake-ups for %g s ...", length_s);
      (void)std::fflush(stdout);
    }
    run_ = try_latency({.period = robot_.cycle, .length = from_seconds(length_s), .place = place_});
    (void)std::printf("%s", coloured_ ? "\r\033[K" : "");
    tell(latency_checks(*run_));
    (void)std::printf("%s\n", latency_text(*run_).c_str());
  }

  /// The sum, the JSON file, the exit status.
  [[nodiscard]] int conclude() const {
    const Sum sum = sum_of(groups_);
    if (!options_.json.empty()) {
      if (const auto written = write_file(options_.json, doctor_json(robot_.name, groups_, run_)); !written) {
        return refuse(written.error());
      }
      say("wrote", options_.json);
    }
    (void)std::printf("%s", sum_text(sum, coloured_).c_str());
    return sum.faults > 0 ? exit_status::kFaultOrStop : exit_status::kEnded;
  }

  [[nodiscard]] const MachineFiles& files() const noexcept { return files_; }
  [[nodiscard]] LoopCpu cpu() const {
    LoopCpu cpu{.bound = robot_.loop.cpu, .examined = place_.cpu};
    if (!options_.robot.empty()) {
      cpu.robot_file = options_.robot;
    }
    return cpu;
  }

 private:
  /// Reads, as `ivo wheels list` does; beside a controller that is running it only listens.
  [[nodiscard]] Group drives() const {
    wheels::Options look;
    look.can = options_.can;
    look.robot = options_.robot;
    const auto world = wheels::World::open(look, wheels::World::Purpose::kLook);
    if (!world) {
      return {kDrives, {fault("answer", world.error().message, "`ip -details link show " + options_.can + "`")}};
    }
    const auto scan = std::make_unique<NodeScan>(world.value()->bus(), robot_, NodeScan::everyone());
    wheels::run_scan(*world.value(), *scan);
    return drive_checks(*scan, robot_, options_.can);
  }

  const Options& options_;
  const Robot& robot_;
  MachineFiles files_;
  hal::RealTimePlace place_;
  bool coloured_ = coloured();
  std::vector<Group> groups_;
  std::optional<LatencyRun> run_;
};

}  // namespace

int examine(const Options& options) {
  const Result<Robot> robot = options.robot.empty() ? Result<Robot>(Robot{}) : read_robot(options.robot);
  if (!robot) {
    return refuse(robot.error());
  }
  if (!options.json.empty()) {
    if (const Result<void> writable = check_writable(options.json); !writable) {
      return refuse(writable.error());
    }
  }
  const Result<DiskFacts> disk = try_disk(options.out);
  if (!disk) {
    return refuse(disk.error());
  }
  end_on_signals("ivo: stopped before all was checked\n");
  say("robot", robot.value().name + ", " +
                   (options.robot.empty() ? "built in, as config/robots/ivo.toml" : options.robot) +
                   format(": a cycle of %g ms", 1e3 * seconds(robot.value().cycle)));
  (void)std::printf("\n");
  Examination examination(options, robot.value());
  const MachineFiles& files = examination.files();
  examination.tell(kernel_checks(files));
  examination.tell(processor_checks(files, examination.cpu()));
  examination.tell(examination.privileges());
  examination.tell(memory_checks(files, kNeededBytes));
  examination.bus();
  examination.tell(watchdog_checks(files));
  examination.tell(disk_checks(disk.value()));
  examination.latency();
  return examination.conclude();
}

}  // namespace ivo::firmware::doctor
