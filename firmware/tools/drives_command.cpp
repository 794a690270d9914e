#include "firmware/tools/drives_command.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <ostream>
#include <string_view>
#include <utility>

#include "firmware/files/eds_file.hpp"
#include "firmware/files/robot_file.hpp"
#include "firmware/files/sim_script_file.hpp"
#include "firmware/tools/drives_log.hpp"
#include "hal/linux/monotonic_clock.hpp"
#include "hal/linux/socketcan_bus.hpp"

namespace ivo::firmware {
namespace {

using TimeFrom = drivers::SimDrives::TimeFrom;
using Scripts = drivers::SimDrives::Scripts;

constexpr Duration kTick = std::chrono::milliseconds(1);
constexpr Duration kLookForSignal = std::chrono::milliseconds(100);

Result<TimeFrom> parse_clock(std::string_view name) {
  if (name == "real") {
    return TimeFrom::kClock;
  }
  if (name == "sync") {
    return TimeFrom::kSync;
  }
  return Error{"--clock is real or sync, not \"" + std::string(name) + "\""};
}

Result<void> take(DrivesOptions& options, std::string_view name, std::string_view value) {
  if (name == "--can") {
    options.interface = value;
  } else if (name == "--robot") {
    options.robot_path = value;
  } else if (name == "--eds") {
    options.eds_path = value;
  } else if (name == "--script") {
    options.script_path = value;
  } else if (name == "--log") {
    options.log_path = value;
  } else {
    const Result<TimeFrom> time_from = parse_clock(value);
    if (!time_from.ok()) {
      return time_from.error();
    }
    options.time_from = time_from.value();
  }
  return {};
}

struct Dictionaries {
  std::array<std::unique_ptr<drivers::EdsDictionary>, kWheels> read;
  drivers::SimDrives::Dictionaries by_wheel{};
};

Result<Dictionaries> read_dictionaries(const DrivesOptions& options, const Robot& robot) {
  Dictionaries dictionaries;
  for (std::size_t i = 0; i < dictionaries.read.size(); ++i) {
    const std::string& path = options.eds_path.empty() ? robot.drives[i].eds : options.eds_path;
    dictionaries.by_wheel[i] = &drivers::ivo_drive_eds();
    if (path.empty()) {
      continue;
    }
    Result<std::unique_ptr<drivers::EdsDictionary>> dictionary = read_simulated_eds(path);
    if (!dictionary) {
      return dictionary.error();
    }
    dictionaries.read[i] = std::move(dictionary).value();
    dictionaries.by_wheel[i] = dictionaries.read[i].get();
  }
  return dictionaries;
}

void simulate(hal::SocketCanBus& bus, drivers::SimDrives& drives, TimeFrom time_from, DrivesLog& log,
              const std::atomic<bool>& stop) {
  hal::MonotonicClock clock;
  Instant tick = clock.now();
  while (!stop.load(std::memory_order_relaxed)) {
    const Instant now = clock.now();
    drives.update(now);
    log.write(drives);
    tick = std::max(tick + kTick, now);
    (void)bus.wait_readable(time_from == TimeFrom::kSync ? kLookForSignal : tick - now);
  }
}

}  // namespace

const char* drives_usage() noexcept {
  return "usage: ivo-drives --can IFACE [--robot FILE] [--eds FILE] [--script FILE] [--log FILE] [--clock real|sync]\n"
         "Simulates the robot's four wheel drives on a CAN interface until it gets SIGINT or SIGTERM.\n"
         "  --can IFACE    CAN interface, as vcan0\n"
         "  --robot FILE   robot file: node-ids and units of the drives, and what EDS each has; without it those of\n"
         "                 config/robots/ivo.toml\n"
         "  --eds FILE     what all four are; without it as the robot file says, else config/eds/ivo_drive.eds\n"
         "  --script FILE  what they do wrong and when\n"
         "  --log FILE     a line for each change of a drive's states, and when its wheel turns or rests\n"
         "  --clock real   the drives keep their own time (default)\n"
         "  --clock sync   each SYNC is one cycle further and nothing else moves time: for ivo run --clock sync\n";
}

Result<DrivesOptions> parse_drives_options(std::span<const char* const> arguments) {
  DrivesOptions options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view name = arguments[i];
    if (name == "--help" || name == "-h") {
      options.help = true;
      return options;
    }
    constexpr std::array<std::string_view, 6> kNames = {"--can", "--robot", "--eds", "--script", "--log", "--clock"};
    if (std::find(kNames.begin(), kNames.end(), name) == kNames.end()) {
      return Error{"unknown argument \"" + std::string(name) +
                   "\": expected --can, --robot, --eds, --script, --log or --clock"};
    }
    if (++i == arguments.size()) {
      return Error{std::string(name) + " expects a value"};
    }
    if (const Result<void> taken = take(options, name, arguments[i]); !taken.ok()) {
      return taken.error();
    }
  }
  if (options.interface.empty()) {
    return Error{"--can IFACE is missing: the CAN interface to simulate drives on, as vcan0"};
  }
  return options;
}

Result<void> run_drives(const DrivesOptions& options, const std::atomic<bool>& stop, std::ostream& out) {
  const Result<Robot> robot = options.robot_path.empty() ? Result<Robot>(Robot{}) : read_robot(options.robot_path);
  if (!robot.ok()) {
    return robot.error();
  }
  const Result<Dictionaries> dictionaries = read_dictionaries(options, robot.value());
  if (!dictionaries.ok()) {
    return dictionaries.error();
  }
  const Result<Scripts> scripts =
      options.script_path.empty() ? Result<Scripts>(Scripts{}) : read_sim_script(options.script_path);
  if (!scripts.ok()) {
    return scripts.error();
  }
  DrivesLog log;
  if (const Result<void> opened = log.open(options.log_path); !opened.ok()) {
    return opened.error();
  }
  Result<hal::SocketCanBus> bus = hal::SocketCanBus::open(options.interface);
  if (!bus.ok()) {
    return bus.error();
  }
  drivers::SimDrives drives(bus.value(), robot.value(), options.time_from, scripts.value(),
                            dictionaries.value().by_wheel);
  drives.open();
  out << "ivo-drives: four simulated drives (nodes";
  for (const DriveParameters& drive : robot.value().drives) {
    out << ' ' << int{drive.node_id};
  }
  out << ") on " << options.interface << std::endl;
  simulate(bus.value(), drives, options.time_from, log, stop);
  const hal::BusCounters counters = bus.value().counters();
  out << "ivo-drives: " << counters.received << " frames received, " << counters.sent << " sent, "
      << counters.receive_dropped << " lost in receiving, " << counters.send_dropped << " in sending" << std::endl;
  return {};
}

}  // namespace ivo::firmware
