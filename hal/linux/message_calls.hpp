// The two system calls of a cycle, each in a function of its own: what a real-time checker must be told of is here.
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <span>

namespace ivo::hal {

/// Neither waits.
struct CallResult {
  std::size_t count = 0;  ///< messages received or taken, the first ones
  int error = 0;          ///< errno when there was not one; 0 when there was, even if the next one failed
};

[[nodiscard]] CallResult receive_messages(int socket, std::span<mmsghdr> messages) noexcept;
[[nodiscard]] CallResult send_messages(int socket, std::span<mmsghdr> messages) noexcept;

}  // namespace ivo::hal
