#include "hal/linux/message_calls.hpp"

#include <cerrno>

#include "config/base/realtime.hpp"

namespace ivo::hal {

CallResult receive_messages(int socket, std::span<mmsghdr> messages) noexcept {
  const KnownNotToWait exempt;  // MSG_DONTWAIT: it takes what is there
  const int got = recvmmsg(socket, messages.data(), static_cast<unsigned>(messages.size()), MSG_DONTWAIT, nullptr);
  return got < 0 ? CallResult{0, errno} : CallResult{static_cast<std::size_t>(got), 0};
}

CallResult send_messages(int socket, std::span<mmsghdr> messages) noexcept {
  const KnownNotToWait exempt;  // MSG_DONTWAIT: what the queue has no room for stays here
  const int took =
      sendmmsg(socket, messages.data(), static_cast<unsigned>(messages.size()), MSG_DONTWAIT | MSG_NOSIGNAL);
  return took < 0 ? CallResult{0, errno} : CallResult{static_cast<std::size_t>(took), 0};
}

}  // namespace ivo::hal
