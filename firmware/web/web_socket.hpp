// One WebSocket of libwebsockets: collects what comes into messages, writes what its session has, one frame whenever
// the connection takes one, and notices a client that is silent or does not read.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "config/base/time.hpp"
#include "firmware/web/ros/ros_session.hpp"
#include "firmware/web/session.hpp"

struct lws;

namespace ivo::firmware::web {

class WebSocket {
 public:
  static constexpr Duration kSilent = std::chrono::seconds(5);
  static constexpr Duration kUnread = std::chrono::seconds(5);
  static constexpr std::size_t kLongestRosMessage = RosSession::kMostBytes;

  /// `session` outlives this.
  WebSocket(lws* connection, Session& session, bool ros, Instant now);

  // Each of these says false when the connection is to be closed.
  [[nodiscard]] bool received(std::string_view part, Instant now);
  [[nodiscard]] bool pong(std::string_view payload, Instant now);
  [[nodiscard]] bool writable(Instant now);
  /// Every few milliseconds.
  [[nodiscard]] bool turn(Instant now);
  void close_because(const char* why) noexcept { complaint_ = why; }
  /// For a person: why it is to be closed.
  [[nodiscard]] const char* complaint() const noexcept { return complaint_; }
  [[nodiscard]] const Session& session() const noexcept { return session_; }

 private:
  [[nodiscard]] bool write(const Frame& frame, Instant now);
  [[nodiscard]] bool ping(Instant now);
  void written(Instant now);

  lws* connection_;
  Session& session_;
  bool ros_;
  std::string message_;
  bool too_long_ = false;
  Instant heard_at_;
  Instant pinged_at_;
  std::uint32_t pings_ = 0;  // the number of the last
  bool pinging_ = false;     // it is partly written
  bool asked_to_write_ = false;
  Instant asked_to_write_at_{};
  bool partly_written_ = false;
  const char* complaint_ = "closed by the other end";
};

}  // namespace ivo::firmware::web
