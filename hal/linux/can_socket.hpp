// A CAN_RAW socket set up for the loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::hal {

struct CanSocketOptions {
  std::vector<std::uint16_t> ids;  ///< heard, each by a filter of its own; none: every plain 11-bit data frame
  bool hear_own = true;            ///< frames that this socket sends come back when they leave
  int receive_bytes = 1 << 20;     ///< kernel's queue: of 1 MiB about 2,700 frames, 300 ms of a saturated 1 Mbit/s bus
};

struct CanSocket {
  FileDescriptor socket;
  int index = 0;  ///< of the interface that it is bound to
};

/// The most COB-IDs that the kernel filters for one socket.
inline constexpr std::size_t kFilterIds = 512;

/// Non-blocking; hears plain 11-bit data frames (no remote, extended or FD frames, though they bear the same low bits)
/// and all error frames, with arrival stamps and a count of what it lost. `name` must exist, carry CAN and be up.
[[nodiscard]] Result<CanSocket> open_can_socket(const std::string& name, const CanSocketOptions& options);

}  // namespace ivo::hal
