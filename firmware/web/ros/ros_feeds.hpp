// What a ROS client has subscribed to, and when each topic is due.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "firmware/web/ros/ros_frame.hpp"
#include "firmware/web/ros/ros_mission.hpp"
#include "firmware/web/ros/ros_topics.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

struct RosSubscription {
  std::string id;  ///< a JSON value; empty: none was given
  Duration throttle{};
  bool cbor = false;
};

/// A message goes once to a client, however often it has subscribed: as often as the most impatient subscription has
/// it, as CBOR when one of them wants it so. Only the newest value of a topic is ever sent.
class RosFeeds {
 public:
  static constexpr std::size_t kMost = 64;              ///< subscriptions
  static constexpr std::size_t kMostBytes = 8U << 20U;  ///< taken at once, and a frame; the others are taken next

  /// The topic's newest value follows as soon as it may: who subscribes again is sent no more for that. Refuses an
  /// unknown topic, another type than the topic has, and one too many. `mission` null: whether there is such an agent
  /// is looked at later.
  [[nodiscard]] Result<void> subscribe(const std::string& name, const std::string& type, RosSubscription subscription,
                                       const RosMission* mission);
  /// Without an id all of the topic's. False when there was none.
  bool unsubscribe(const std::string& name, const std::string& id);

  /// Frames that are due. Topics of agents whom the mission does not have are given up; their names are added to
  /// `unknown`.
  void take(std::vector<Frame>& frames, std::vector<std::string>& unknown, const View& view, const RosMission* mission,
            Instant now, Duration since_epoch);

 private:
  struct Feed {
    std::string name;  // as the client spells it
    Topic<Outgoing> topic;
    bool ros2 = true;
    std::vector<RosSubscription> subscriptions;  // none: it waits to be forgotten
    std::uint64_t sent = 0;                      // version
    std::optional<Instant> sent_at;
    std::optional<Instant> due;
    std::uint32_t sequence = 0;
  };

  [[nodiscard]] std::size_t count() const;
  static void send(std::vector<Frame>& frames, Feed& feed, const View& view, const RosMission& mission, Instant now,
                   Duration since_epoch);
  void forget(std::vector<std::string>& unknown, const RosMission* mission, Instant now);

  std::vector<Feed> feeds_;
  std::size_t next_ = 0;  // for which there was no room
};

}  // namespace ivo::firmware::web
