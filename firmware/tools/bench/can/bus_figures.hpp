// What the bus costs and carries, apart from faults.
#pragma once

#include "firmware/tools/bench/bench.hpp"

namespace ivo::firmware::bench {

/// Receive and send of one full cycle through the socket: time, and system calls as the kernel counts them.
void cycle_cost(const Options& options, Sheet& sheet);

/// Frames a second from process to process, beside cangen and candump on the same interface.
void frames_a_second(const Options& options, Sheet& sheet);

/// What the robot's layout promises, and what a listener counts while it drives.
void bus_load(const Options& options, Sheet& sheet);

}  // namespace ivo::firmware::bench
