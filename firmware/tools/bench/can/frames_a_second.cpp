// How many frames a second go from one process to another, beside can-utils' own sender and receiver.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "config/limits.hpp"
#include "firmware/tools/bench/can/bus_figures.hpp"
#include "firmware/tools/bench/can/fault_rig.hpp"
#include "firmware/tools/bench/can/tool.hpp"
#include "firmware/tools/bench/guest.hpp"
#include "hal/linux/monotonic_clock.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr int kFrames = 60'000;
constexpr int kQuickFrames = 10'000;
constexpr int kFewFrames = 100;
constexpr int kShortRuns = 3;
constexpr int kBatch = 10;  // as in a cycle
constexpr std::uint16_t kFirstId = 0x181;
constexpr Duration kPatience = std::chrono::seconds(3);
constexpr int kReceiveBytes = 32 << 20;

/// The receiver's process. Its exit status is 0 when every frame came.
[[noreturn]] void receive_all(hal::SocketCanBus& to, std::size_t frames) {
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> received;
  hal::MonotonicClock clock;
  std::size_t arrived = 0;
  while (arrived < frames && to.wait_readable(kPatience)) {
    arrived += to.receive(received, clock.now());
  }
  _exit(arrived == frames ? 0 : 1);
}

/// Seconds from before there is a receiver until it has ended; an error when frames were lost.
Result<double> ours(int frames) {
  Result<hal::SocketCanBus> from = hal::SocketCanBus::open(FaultRig::kMasterSide);
  Result<hal::SocketCanBus> to = hal::SocketCanBus::open(FaultRig::kMasterSide, {.receive_bytes = kReceiveBytes});
  if (!from || !to) {
    return !from ? from.error() : to.error();
  }
  std::array<hal::CanFrame, kBatch> batch{};
  for (std::size_t i = 0; i < batch.size(); ++i) {
    batch[i] = {.id = static_cast<std::uint16_t>(kFirstId + i), .size = 6, .data = {1, 2, 3, 4, 5, 6}};
  }
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> echoes;
  hal::MonotonicClock clock;
  const Instant begin = clock.now();
  const pid_t receiver = fork();
  if (receiver < 0) {
    return Error{"no process for the receiver"};
  }
  if (receiver == 0) {
    receive_all(to.value(), static_cast<std::size_t>(frames));
  }
  for (int sent = 0; sent < frames; sent += kBatch) {
    (void)from.value().send(batch, clock.now());
    // Confirmed, then the next: a newer frame of a COB-ID takes the place of one that waits.
    do {
      (void)from.value().receive(echoes, clock.now());
    } while (from.value().in_flight() > 0 && from.value().wait_readable(kPatience));
  }
  int status = 1;
  const bool ended = waitpid(receiver, &status, 0) == receiver;
  return ended && status == 0 ? Result<double>(seconds(clock.now() - begin)) : Error{"frames were lost"};
}

/// The same of cangen, which sends as fast as it goes, and candump, which ends with the last frame; its queue is as
/// long.
Result<double> of_can_utils(int frames) {
  const std::string script = R"(
    log=$(mktemp -p /dev/shm)
    candump -L -n "$1" -T 3000 -r 33554432 "$0" >"$log" &
    until grep -q "^ *$0 " /proc/net/can/rcvlist_all /proc/net/can/rcvlist_fil; do sleep 0.01; done
    cangen "$0" -g 0 -p 100 -I 181 -L 6 -D 010203040506 -n "$1"
    wait
    lines=$(wc -l <"$log")
    rm -f "$log"
    [ "$lines" -eq "$1" ])";
  hal::MonotonicClock clock;
  const Instant begin = clock.now();
  const Result<void> ran = run_tool({"bash", "-c", script, FaultRig::kMasterSide, std::to_string(frames)});
  return ran ? Result<double>(seconds(clock.now() - begin)) : Error{"cangen and candump are not there, or lost frames"};
}

/// Frames a second, without what it takes to begin and to end: the difference of a long and of the briefest short run.
template <class Run>
Result<double> rate_of(const Run& run, int frames) {
  Result<double> brief = run(kFewFrames);
  for (int i = 1; i < kShortRuns && brief; ++i) {
    const Result<double> again = run(kFewFrames);
    brief = again ? Result<double>(std::min(brief.value(), again.value())) : again;
  }
  const Result<double> whole = brief ? run(frames + kFewFrames) : brief;
  if (!whole) {
    return whole.error();
  }
  const double taken_s = whole.value() - brief.value();
  return taken_s > 0.0 ? Result<double>(frames / taken_s)
                       : Result<double>(Error{"a long run took no longer than a short one"});
}

}  // namespace

void frames_a_second(const Options& options, Sheet& sheet) {
  sheet.clock(clock_of_this_kernel());
  const std::string name = "frames from process to process";
  const int frames = options.quick ? kQuickFrames : kFrames;
  const Result<double> rate = rate_of(ours, frames);
  const Result<double> theirs = rate_of(of_can_utils, frames);
  if (!rate || !theirs) {
    return sheet.skip(name, (!rate ? rate.error() : theirs.error()).message);
  }
  sheet.add(name, "ours", rate.value(), "1/s");
  sheet.add(name, "cangen and candump", theirs.value(), "1/s");
  sheet.add(name, "ratio", rate.value() / theirs.value(), "", Target{1.0, Sense::kAtLeast});
}

}  // namespace ivo::firmware::bench
