// One ROS client that speaks rosbridge's protocol: hears its messages, gives it those that it has subscribed to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/time.hpp"
#include "firmware/console/console_messages.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/web/ros/ros_commands.hpp"
#include "firmware/web/ros/ros_feeds.hpp"
#include "firmware/web/ros/ros_frame.hpp"
#include "firmware/web/ros/ros_mission.hpp"
#include "firmware/web/ros/ros_pace.hpp"
#include "firmware/web/verdict.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

class RosSession {
 public:
  static constexpr std::size_t kMostBytes = 4U << 20U;  ///< of a message: a point cloud is large
  static constexpr std::size_t kMostValues = 300'000;   ///< of a message
  static constexpr std::size_t kMostName = 256;         ///< of a topic, a service, a type, an id
  static constexpr std::size_t kMostPending = 64;       ///< asked and not answered
  static constexpr std::size_t kMostFrames = 256;       ///< answers that wait to be taken; what is beyond is counted
  static constexpr Duration kPatience = std::chrono::seconds(10);  ///< for an answer

  /// Both outlive this. `epoch`: what to add to an Instant for the time since 1970; without it stamps count from
  /// whatever the Instants do.
  RosSession(const View& view, RosCommands& commands, Duration epoch = {})
      : view_(view), commands_(commands), epoch_(epoch) {}

  /// A whole message of the client. What is wrong with it is said in a status message, and counted.
  void hear(std::string_view message, bool binary, Instant now);
  /// What became of what commands.ask() gave that number to.
  void answered(std::uint32_t ask, Verdict verdict);
  /// What is to be sent now, in order. Asked for often, and only while the client reads what it is sent.
  [[nodiscard]] std::vector<Frame> take(Instant now);

  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }  ///< answers for which there was no room

 private:
  enum class StatusLevel : std::uint8_t { kNone, kError, kWarning, kInfo };
  struct Pending {
    std::uint32_t ask = 0;
    std::string id;    // of the message, as JSON
    std::string name;  // of topic or service
    bool service = false;
    Instant at{};
    std::uint32_t plan = 0;  // that it accepts
  };

  [[nodiscard]] const RosMission* mission();
  void hear_operation(const std::string& op, const Json& message, const std::string& id, Instant now);
  void hear_advertise(const Json& message, const std::string& id);
  void hear_publish(const Json& message, const std::string& id, Instant now);
  void hear_subscribe(const Json& message, const std::string& id);
  void hear_unsubscribe(const Json& message, const std::string& id);
  void hear_call(const Json& message, const std::string& id, Instant now);
  void hear_level(const Json& message, const std::string& id);

  void ask(const Request& request, const std::string& id, const std::string& name, bool service, Instant now);
  void finish(const Pending& pending, Verdict verdict);
  void refuse(const std::string& id, std::string_view about, std::string_view what);
  void say(StatusLevel level, const std::string& id, const std::string& text);
  void respond(const std::string& id, const std::string& service, bool result, std::string_view values);
  void put(std::string text);

  const View& view_;
  RosCommands& commands_;
  Duration epoch_;
  std::optional<RosMission> mission_;
  std::uint32_t mission_revision_ = 0;
  RosFeeds feeds_;
  RosPace pace_;
  StatusLevel level_ = StatusLevel::kError;
  std::vector<Pending> pending_;
  std::array<Instant, console::kAreaSlots> claimed_until_{};  // put, and perhaps not among the view's areas yet
  std::uint32_t accepted_plan_ = 0;
  std::uint64_t connections_ = 0;  // of the view: another run counts its plans anew
  std::vector<Frame> frames_;
  std::uint64_t refused_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace ivo::firmware::web
