// The message arrays of the two calls, laid out once.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>
#include <time.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "config/base/time.hpp"
#include "config/limits.hpp"
#include "hal/api/can_frame.hpp"
#include "hal/linux/message_calls.hpp"

namespace ivo::hal {

template <std::size_t Count>
struct MessageArray {
  std::array<can_frame, Count> frames{};
  std::array<iovec, Count> places{};
  std::array<mmsghdr, Count> headers{};

  MessageArray() noexcept {
    for (std::size_t i = 0; i < Count; ++i) {
      places[i] = {.iov_base = &frames[i], .iov_len = sizeof(can_frame)};
      headers[i].msg_hdr.msg_iov = &places[i];
      headers[i].msg_hdr.msg_iovlen = 1;
    }
  }
  MessageArray(const MessageArray&) = delete;
  MessageArray& operator=(const MessageArray&) = delete;
};

/// Received messages, taken one by one; what one call brought and the caller has no room for stays for the next.
class ReceivedMessages {
 public:
  /// A cycle's data frames; beside them our own, which come back (about 10), and error frames: at 1 Mbit/s each takes
  /// 20 bits or more of the bus, 100 a cycle at most. So one call takes all that there is, in a flood too.
  static constexpr std::size_t kRoom = limits::kFramesPerCycle + 256;

  struct Notes {             // what the kernel says beside a message
    Duration stamp{};        ///< of its arrival, on the wall clock; 0: none
    std::uint32_t lost = 0;  ///< frames that the socket had lost by then, in all
    bool tells_lost = false;
  };

  ReceivedMessages() noexcept;

  /// Only when empty().
  [[nodiscard]] CallResult fetch(int socket) noexcept;
  [[nodiscard]] bool empty() const noexcept { return next_ == count_; }
  /// Whether the last fetch() left nothing that had arrived before it.
  [[nodiscard]] bool drained() const noexcept { return empty() && count_ < kRoom; }

  // Of the first message that is left:
  [[nodiscard]] const can_frame& frame() const noexcept { return array_.frames[next_]; }
  [[nodiscard]] int flags() const noexcept { return array_.headers[next_].msg_hdr.msg_flags; }
  [[nodiscard]] bool whole() const noexcept;
  [[nodiscard]] Notes notes() noexcept;
  void pop() noexcept { ++next_; }

 private:
  using Stamps = std::array<timespec, 3>;  // by software, by nobody any more, by hardware: as SCM_TIMESTAMPING has them
  struct alignas(cmsghdr) Control {
    std::array<char, CMSG_SPACE(sizeof(std::uint32_t)) + CMSG_SPACE(sizeof(Stamps))> bytes;
  };

  MessageArray<kRoom> array_;
  std::array<Control, kRoom> controls_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

class SentMessages {
 public:
  static constexpr std::size_t kRoom = limits::kFramesPerCycle;

  /// Hands over `frames`, at most kRoom; the count says how many of them, the first ones, were taken.
  [[nodiscard]] CallResult send(int socket, std::span<const CanFrame> frames) noexcept;

 private:
  MessageArray<kRoom> array_;
};

}  // namespace ivo::hal
