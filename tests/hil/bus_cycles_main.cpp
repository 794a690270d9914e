// bus_cycles INTERFACE CYCLES: the bus side of the control loop and nothing else, for counting what it asks of the
// kernel: receive, send SYNC and four commands, sleep.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>

#include "hal/linux/monotonic_clock.hpp"
#include "hal/linux/socketcan_bus.hpp"

namespace {

constexpr ivo::Duration kCycle = std::chrono::milliseconds(10);

}  // namespace

int main(int argc, char** argv) {
  using ivo::hal::CanFrame;
  if (argc != 3) {
    std::cerr << "usage: bus_cycles INTERFACE CYCLES\n";
    return 2;
  }
  ivo::Result<ivo::hal::SocketCanBus> bus = ivo::hal::SocketCanBus::open(argv[1]);
  if (!bus) {
    std::cerr << bus.error().message << '\n';
    return 2;
  }
  std::array<CanFrame, 5> frames{};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i] = {.id = static_cast<std::uint16_t>(i == 0 ? 0x80 : 0x200 + i), .size = 6, .data = {}};
  }
  std::array<ivo::hal::ReceivedFrame, 64> received;
  const long cycles = std::strtol(argv[2], nullptr, 10);
  ivo::hal::MonotonicClock clock;
  ivo::Instant deadline = clock.now();
  std::uint64_t taken = 0;
  (void)write(STDOUT_FILENO, "begin\n", 6);  // a mark in the trace
  for (long cycle = 0; cycle < cycles; ++cycle) {
    const ivo::Instant now = clock.now();
    (void)bus.value().receive(received, now);
    taken += bus.value().send(frames, now);
    deadline = std::max(deadline + kCycle, now);
    clock.sleep_until(deadline);
  }
  (void)write(STDOUT_FILENO, "end\n", 4);
  std::cout << taken << " frames taken\n";
  return 0;
}
