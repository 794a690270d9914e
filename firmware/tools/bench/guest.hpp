// A bench once more in a guest: where there is a bus that nobody else uses (toolchain/vcan), or time that nobody else
// disturbs (toolchain/rt).
#pragma once

#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/tools/bench/bench.hpp"

namespace ivo::firmware::bench {

/// Whether the interfaces here are this program's own to break: inside a guest.
[[nodiscard]] bool owns_network();
/// Whether this is toolchain/rt's guest: a real-time kernel whose clock counts instructions.
[[nodiscard]] bool counts_instructions();
/// "CLOCK_MONOTONIC", and whose.
[[nodiscard]] const char* clock_of_this_kernel() noexcept;

enum class Guest : std::uint8_t { kVcan, kRealTime };

/// Runs `ivo bench NAME` in the guest, whose script is looked for in the folders above this program, and returns its
/// records. An error, in one line, when it cannot be started or fails.
[[nodiscard]] Result<std::vector<Record>> records_from_guest(Guest guest, const std::string& bench,
                                                             const Options& options);

}  // namespace ivo::firmware::bench
