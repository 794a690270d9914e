// How many frames a second go from one socket to another, beside can-utils' own sender and receiver.
#include <poll.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/limits.hpp"
#include "firmware/tools/bench/can/bus_figures.hpp"
#include "firmware/tools/bench/can/fault_rig.hpp"
#include "firmware/tools/bench/can/tool.hpp"
#include "hal/linux/monotonic_clock.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr int kFrames = 60'000;
constexpr int kQuickFrames = 10'000;
constexpr int kBatch = 10;  // as in a cycle
constexpr std::uint16_t kFirstId = 0x181;

/// None when frames were lost.
std::optional<double> ours(hal::SocketCanBus& from, hal::SocketCanBus& to, int frames) {
  std::array<hal::CanFrame, kBatch> batch{};
  for (std::size_t i = 0; i < batch.size(); ++i) {
    batch[i] = {.id = static_cast<std::uint16_t>(kFirstId + i), .size = 6, .data = {1, 2, 3, 4, 5, 6}};
  }
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> received;
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> echoes;
  hal::MonotonicClock clock;
  const Instant begin = clock.now();
  std::size_t arrived = 0;
  for (int sent = 0; sent < frames; sent += kBatch) {
    (void)from.send(batch, clock.now());
    (void)from.receive(echoes, clock.now());
    arrived += to.receive(received, clock.now());
  }
  while (arrived < static_cast<std::size_t>(frames) && to.wait_readable(std::chrono::milliseconds(100))) {
    arrived += to.receive(received, clock.now());
  }
  const double taken_s = seconds(clock.now() - begin);
  return arrived == static_cast<std::size_t>(frames) ? std::optional(frames / taken_s) : std::nullopt;
}

/// cangen sends as fast as it goes. candump comes first in line for the processor where that is allowed, or it loses
/// frames; it ends with the last one.
Result<double> of_can_utils(int frames) {
  const std::string script = R"(
    log=$(mktemp -p /dev/shm)
    first=; chrt --fifo 1 true 2>/dev/null && first='chrt --fifo 1'
    $first candump -L -n "$1" -T 3000 -r 33554432 "$0" >"$log" &
    until grep -q "^ *$0 " /proc/net/can/rcvlist_all /proc/net/can/rcvlist_fil; do sleep 0.01; done
    cangen "$0" -g 0 -p 100 -I 181 -L 6 -D 010203040506 -n "$1"
    wait
    lines=$(wc -l <"$log")
    rm -f "$log"
    [ "$lines" -eq "$1" ])";
  hal::MonotonicClock clock;
  const Instant begin = clock.now();
  const Result<void> ran = run_tool({"bash", "-c", script, FaultRig::kMasterSide, std::to_string(frames)});
  const double taken_s = seconds(clock.now() - begin);
  return ran ? Result<double>(frames / taken_s) : Error{"cangen and candump are not there, or lost frames"};
}

}  // namespace

void frames_a_second(const Options& options, Sheet& sheet) {
  sheet.clock(clock_of_this_kernel());
  const std::string name = "frames from socket to socket";
  const int frames = options.quick ? kQuickFrames : kFrames;
  Result<hal::SocketCanBus> from = hal::SocketCanBus::open(FaultRig::kMasterSide);
  Result<hal::SocketCanBus> to = hal::SocketCanBus::open(FaultRig::kMasterSide);
  if (!from || !to) {
    return sheet.skip(name, (!from ? from.error() : to.error()).message);
  }
  const std::optional<double> rate = ours(from.value(), to.value(), frames);
  const Result<double> theirs = of_can_utils(frames);
  if (!rate || !theirs) {
    return sheet.skip(name, !rate ? "frames were lost" : theirs.error().message);
  }
  sheet.add(name, "ours", *rate, "1/s");
  sheet.add(name, "cangen and candump", theirs.value(), "1/s");
  sheet.add(name, "ratio", *rate / theirs.value(), "", Target{1.0, Sense::kAtLeast});
}

}  // namespace ivo::firmware::bench
