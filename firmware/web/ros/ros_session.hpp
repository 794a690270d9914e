// One ROS client that speaks rosbridge's protocol: hears its messages, gives it those that it has subscribed to.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/time.hpp"
#include "firmware/web/ros/ros_commands.hpp"
#include "firmware/web/verdict.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

/// One WebSocket message.
struct Frame {
  std::string bytes;
  bool binary = false;
};

class RosSession {
 public:
  /// Both outlive this.
  RosSession(const View& view, RosCommands& commands) : view_(view), commands_(commands) {}

  /// A whole message of the client, at most 1 MiB.
  void hear(std::string_view message, bool binary, Instant now);
  /// What became of what commands.ask() gave that number to.
  void answered(std::uint32_t ask, Verdict verdict);
  /// What is to be sent now, in order. Asked for often, and only while the client reads what it is sent.
  [[nodiscard]] std::vector<Frame> take(Instant now);

 private:
  const View& view_;
  RosCommands& commands_;
};

}  // namespace ivo::firmware::web
