// One look at the interface that a socket is bound to, and a new socket when the interface is another one.
#pragma once

#include <string>

#include "hal/linux/can_socket.hpp"
#include "hal/linux/socket_handover.hpp"

namespace ivo::hal {

/// An interface that was removed and is back under its name, as a USB adapter that was plugged in again, is a new one:
/// sockets of the old one stay dead.
class InterfaceLook {
 public:
  /// `index`: of the interface that the present socket is bound to. `handover` outlives this.
  InterfaceLook(std::string name, CanSocketOptions options, int index, std::uint32_t bit_rate_bps,
                SocketHandover& handover)
      : name_(std::move(name)),
        options_(std::move(options)),
        index_(index),
        bit_rate_bps_(bit_rate_bps),
        handover_(handover) {}

  /// Reports what there is; when it is up and new, offers a socket on it. An interface that came back at another bit
  /// rate is as good as removed. System calls and heap: not for the loop. One thread at a time.
  void once();

 private:
  std::string name_;
  CanSocketOptions options_;
  int index_;
  std::uint32_t bit_rate_bps_;
  SocketHandover& handover_;
};

}  // namespace ivo::hal
