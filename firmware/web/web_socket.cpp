#include "firmware/web/web_socket.hpp"

#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/web/page_message.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::size_t kKeptBytes = 64U << 10U;  // of room for the next message
constexpr Duration kPingEvery = std::chrono::seconds(1);
constexpr Duration kPingRosEvery = std::chrono::milliseconds(500);  // its answers are an operator's beats

}  // namespace

WebSocket::WebSocket(lws* connection, Session& session, bool ros, Instant now)
    : connection_(connection), session_(session), ros_(ros), heard_at_(now), pinged_at_(now) {}

bool WebSocket::received(std::string_view part, Instant now) {
  heard_at_ = now;
  const std::size_t most = ros_ ? kLongestRosMessage : PageMessage::kLongest;
  if (message_.size() + part.size() <= most && !too_long_) {
    message_ += part;
  } else if (ros_) {
    complaint_ = "sent a message of more than 4 MiB";
    return false;
  } else {
    too_long_ = true;
    message_.assign(most + 1, ' ');  // judged by its length alone
  }
  if (lws_is_final_fragment(connection_) != 0) {
    session_.hear(message_, lws_frame_is_binary(connection_) != 0, now);
    message_.clear();
    if (message_.capacity() > kKeptBytes) {
      message_.shrink_to_fit();
    }
    too_long_ = false;
  }
  return true;
}

bool WebSocket::pong(std::string_view payload, Instant now) {
  heard_at_ = now;
  if (payload == std::to_string(pings_)) {
    session_.alive(pings_, now);
  }
  return true;
}

bool WebSocket::ping(Instant now) {
  pinged_at_ = now;
  const std::string number = std::to_string(++pings_);
  std::array<unsigned char, LWS_PRE + 16> bytes{};
  std::copy(number.begin(), number.end(), bytes.begin() + LWS_PRE);
  if (lws_write(connection_, bytes.data() + LWS_PRE, number.size(), LWS_WRITE_PING) < 0) {
    return false;
  }
  pinging_ = true;
  partly_written_ = lws_partial_buffered(connection_) != 0;
  if (!partly_written_) {
    written(now);
  }
  return true;
}

void WebSocket::written(Instant now) {
  partly_written_ = false;
  if (std::exchange(pinging_, false)) {
    session_.pinged(pings_, now);
  } else {
    session_.written(now);
  }
}

bool WebSocket::write(const Frame& frame, Instant now) {
  std::vector<unsigned char> bytes(LWS_PRE + frame.bytes.size());
  std::copy(frame.bytes.begin(), frame.bytes.end(), bytes.begin() + LWS_PRE);
  const int count = lws_write(connection_, bytes.data() + LWS_PRE, frame.bytes.size(),
                              frame.binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT);
  if (count < static_cast<int>(frame.bytes.size())) {
    return false;
  }
  partly_written_ = lws_partial_buffered(connection_) != 0;
  if (!partly_written_) {
    written(now);
  }
  return true;
}

bool WebSocket::writable(Instant now) {
  asked_to_write_ = false;
  if (partly_written_) {
    written(now);
  }
  if (now - pinged_at_ >= (ros_ ? kPingRosEvery : kPingEvery)) {
    return ping(now);
  }
  const std::optional<Frame> frame = session_.next(now);
  if (!frame) {
    return true;
  }
  asked_to_write_ = true;
  asked_to_write_at_ = now;
  lws_callback_on_writable(connection_);
  return write(*frame, now);
}

bool WebSocket::turn(Instant now) {
  if (now - heard_at_ >= kSilent) {
    complaint_ = "silent for 5 s";
    return false;
  }
  if (session_.overfull() || (asked_to_write_ && now - asked_to_write_at_ >= kUnread)) {
    complaint_ = "does not read what it is sent";
    return false;
  }
  if (!asked_to_write_) {
    asked_to_write_ = true;
    asked_to_write_at_ = now;
    lws_callback_on_writable(connection_);
  }
  return true;
}

}  // namespace ivo::firmware::web
