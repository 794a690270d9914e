#include "hal/linux/message_calls.hpp"

#include <cerrno>

namespace ivo::hal {

CallResult receive_messages(int socket, std::span<mmsghdr> messages) noexcept {
  const int got = recvmmsg(socket, messages.data(), static_cast<unsigned>(messages.size()), MSG_DONTWAIT, nullptr);
  return got < 0 ? CallResult{0, errno} : CallResult{static_cast<std::size_t>(got), 0};
}

CallResult send_messages(int socket, std::span<mmsghdr> messages) noexcept {
  const int took =
      sendmmsg(socket, messages.data(), static_cast<unsigned>(messages.size()), MSG_DONTWAIT | MSG_NOSIGNAL);
  return took < 0 ? CallResult{0, errno} : CallResult{static_cast<std::size_t>(took), 0};
}

}  // namespace ivo::hal
