// Receive and send of a full cycle: nine frames of the drives in, ten of ours out.
#include <sys/syscall.h>

#include <algorithm>
#include <array>
#include <vector>

#include "config/limits.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "firmware/tools/bench/can/bus_figures.hpp"
#include "firmware/tools/bench/can/fault_rig.hpp"
#include "firmware/tools/bench/can/syscall_count.hpp"
#include "firmware/tools/bench/guest.hpp"
#include "hal/linux/monotonic_clock.hpp"

namespace ivo::firmware::bench {
namespace {

namespace cob_id = drivers::cob_id;

constexpr int kCycles = 20'000;
constexpr int kQuickCycles = 2'000;
constexpr int kCountedCycles = 100;
constexpr double kCallsACycle = 2.0;  // recvmmsg and sendmmsg

using Frames = std::vector<hal::CanFrame>;

/// Four feedbacks, four heartbeats and an emergency that says that there is none.
Frames from_drives() {
  Frames frames;
  for (const DriveParameters& drive : Robot{}.drives) {
    frames.push_back({.id = cob_id::tpdo1(drive.node_id), .size = 6, .data = {0x37, 0x12, 1, 2, 3, 4}});
    frames.push_back({.id = cob_id::heartbeat(drive.node_id), .size = 1, .data = {0x05}});
  }
  frames.push_back({.id = cob_id::emcy(1), .size = 8, .data = {}});
  return frames;
}

/// SYNC, four commands, four SDO requests and our heartbeat.
Frames to_drives() {
  const Robot robot;
  Frames frames = {{.id = cob_id::kSync, .size = 0, .data = {}}};
  for (const DriveParameters& drive : robot.drives) {
    frames.push_back({.id = cob_id::rpdo1(drive.node_id), .size = 6, .data = {0x0F, 0, 1, 2, 3, 4}});
    frames.push_back({.id = cob_id::sdo_request(drive.node_id), .size = 8, .data = {0x40, 0, 0x10}});
  }
  frames.push_back({.id = cob_id::heartbeat(robot.master_node_id), .size = 1, .data = {0x05}});
  return frames;
}

struct Buses {
  hal::SocketCanBus master;
  hal::SocketCanBus drives;
};

void drain(hal::SocketCanBus& bus, Instant now) {
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames;
  while (bus.receive(frames, now) > 0) {
  }
}

void add_times(Buses& buses, int cycles, Sheet& sheet) {
  const Frames in = from_drives();
  const Frames out = to_drives();
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames;
  std::vector<double> micros;
  std::size_t received = 0;
  std::size_t sent = 0;
  hal::MonotonicClock clock;
  for (int i = 0; i < cycles; ++i) {
    (void)buses.drives.send(in, clock.now());
    const Instant begin = clock.now();
    received += buses.master.receive(frames, begin);
    sent += buses.master.send(out, begin);
    micros.push_back(seconds(clock.now() - begin) * 1e6);
    drain(buses.drives, clock.now());
  }
  std::sort(micros.begin(), micros.end());
  const std::string name = "receive 9 and send 10 frames";
  const auto n = static_cast<double>(cycles);
  sheet.add(name, "median", micros[micros.size() / 2], "us");
  sheet.add(name, "p99", micros[micros.size() * 99 / 100], "us");
  sheet.add(name, "worst", micros.back(), "us");
  sheet.add(name, "received", static_cast<double>(received) / n, "frames", Target{9.0, Sense::kAtLeast});
  sheet.add(name, "sent", static_cast<double>(sent) / n, "frames", Target{10.0, Sense::kAtLeast});
}

void add_calls(Buses& buses, Sheet& sheet) {
  const Frames in = from_drives();
  const Frames out = to_drives();
  for (int i = 0; i < kCountedCycles; ++i) {
    (void)buses.drives.send(in, Instant{});
  }
  const Result<std::vector<long>> calls = system_calls_of([&] {
    std::array<hal::ReceivedFrame, 2 * 19> frames;  // what came, and own frames that the socket shows us again
    for (int i = 0; i < kCountedCycles; ++i) {
      (void)buses.master.receive(frames, Instant{});
      (void)buses.master.send(out, Instant{});
    }
  });
  const Result<std::vector<long>> of_nothing = system_calls_of([] {});
  const std::string name = "system calls a cycle";
  if (!calls || !of_nothing) {
    return sheet.skip(name, (!calls ? calls.error() : of_nothing.error()).message);
  }
  const auto count = [&](long number) {
    return static_cast<double>(std::count(calls.value().begin(), calls.value().end(), number));
  };
  const double all = static_cast<double>(calls.value().size()) - static_cast<double>(of_nothing.value().size());
  const double on_socket = count(SYS_recvmmsg) + count(SYS_sendmmsg);
  const double on_clock = count(SYS_clock_gettime);  // none where the kernel lends its clock to programs (vDSO)
  sheet.add(name, "recvmmsg and sendmmsg", on_socket / kCountedCycles, "", Target{kCallsACycle});
  sheet.add(name, "clock_gettime", on_clock / kCountedCycles, "", Target{1.0});
  sheet.add(name, "others", (all - on_socket - on_clock) / kCountedCycles, "", Target{0.0});
}

}  // namespace

void cycle_cost(const Options& options, Sheet& sheet) {
  sheet.clock(clock_of_this_kernel());
  Result<hal::SocketCanBus> master = hal::SocketCanBus::open(FaultRig::kMasterSide);
  Result<hal::SocketCanBus> drives = hal::SocketCanBus::open(FaultRig::kMasterSide);
  if (!master || !drives) {
    return sheet.skip("cycle", (!master ? master.error() : drives.error()).message);
  }
  Buses buses{std::move(master).value(), std::move(drives).value()};
  add_times(buses, options.quick ? kQuickCycles : kCycles, sheet);
  add_calls(buses, sheet);
}

}  // namespace ivo::firmware::bench
