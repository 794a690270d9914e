#include "hal/linux/socket_messages.hpp"

#include <algorithm>
#include <cstring>

#include "config/base/contract.hpp"

namespace ivo::hal {

ReceivedMessages::ReceivedMessages() noexcept {
  for (std::size_t i = 0; i < kRoom; ++i) {
    array_.headers[i].msg_hdr.msg_control = controls_[i].bytes.data();
    array_.headers[i].msg_hdr.msg_controllen = sizeof(Control);
  }
}

CallResult ReceivedMessages::fetch(int socket) noexcept {
  IVO_CONTRACT(empty());
  for (std::size_t i = 0; i < count_; ++i) {  // those that the kernel wrote in the last call
    array_.headers[i].msg_hdr.msg_control = controls_[i].bytes.data();
    array_.headers[i].msg_hdr.msg_controllen = sizeof(Control);
  }
  const CallResult result = receive_messages(socket, array_.headers);
  next_ = 0;
  count_ = result.count;
  return result;
}

bool ReceivedMessages::whole() const noexcept {
  return array_.headers[next_].msg_len == sizeof(can_frame) && (flags() & MSG_TRUNC) == 0 &&
         frame().can_dlc <= CAN_MAX_DLEN;
}

ReceivedMessages::Notes ReceivedMessages::notes() noexcept {
  Notes notes;
  msghdr& header = array_.headers[next_].msg_hdr;
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
    if (c->cmsg_level != SOL_SOCKET) {
      continue;
    }
    if (c->cmsg_type == SO_RXQ_OVFL) {
      notes.tells_lost = true;
      std::memcpy(&notes.lost, CMSG_DATA(c), sizeof notes.lost);
    } else if (c->cmsg_type == SCM_TIMESTAMPING) {
      Stamps stamps{};
      std::memcpy(&stamps, CMSG_DATA(c), sizeof stamps);
      notes.stamp = std::chrono::seconds(stamps[0].tv_sec) + Duration(stamps[0].tv_nsec);
    }
  }
  return notes;
}

CallResult SentMessages::send(int socket, std::span<const CanFrame> frames) noexcept {
  IVO_CONTRACT(frames.size() <= kRoom);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    can_frame& raw = array_.frames[i];
    raw = {};
    raw.can_id = frames[i].id;
    raw.can_dlc = frames[i].size;
    std::copy(frames[i].data.begin(), frames[i].data.end(), raw.data);
  }
  return send_messages(socket, std::span(array_.headers).first(frames.size()));
}

}  // namespace ivo::hal
