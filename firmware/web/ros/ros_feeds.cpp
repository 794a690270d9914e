#include "firmware/web/ros/ros_feeds.hpp"

#include <algorithm>
#include <utility>

#include "firmware/web/ros/cbor_writer.hpp"
#include "firmware/web/ros/json_writer.hpp"
#include "firmware/web/ros/ros_outgoing.hpp"

namespace ivo::firmware::web {
namespace {

template <class Writer>
bool write_publication(Writer& writer, const std::string& name, Outgoing what, std::optional<std::size_t> agent,
                       const View& view, const RosMission& mission, const RosStamp& stamp) {
  writer.begin_object();
  writer.add("op", "publish").add("topic", name).key("msg");
  if (!write_message(writer, what, agent, view, mission, stamp)) {
    return false;
  }
  writer.end_object();
  return true;
}

}  // namespace

std::size_t RosFeeds::count() const {
  std::size_t count = 0;
  for (const Feed& feed : feeds_) {
    count += feed.subscriptions.size();
  }
  return count;
}

Result<void> RosFeeds::subscribe(const std::string& name, const std::string& type, RosSubscription subscription,
                                 const RosMission* mission) {
  const std::optional<Topic<Outgoing>> topic = outgoing_topic(name);
  if (!topic) {
    return Error{"unknown; expected a topic of /rosapi/topics that is given out"};
  }
  if (topic->token && mission != nullptr && !mission->agent_of(*topic->token)) {
    return Error{"names an agent that is not there; expected one of /rosapi/topics"};
  }
  if (!type.empty() && short_type(type) != topic->type) {
    return Error{"type: " + type + " is not this topic's; expected " + std::string(topic->type)};
  }
  if (count() >= kMost || feeds_.size() >= 2 * kMost) {
    return Error{"is one too many; expected at most " + std::to_string(kMost) + " subscriptions"};
  }
  auto feed = std::find_if(feeds_.begin(), feeds_.end(), [&](const Feed& f) { return f.name == name; });
  if (feed == feeds_.end()) {
    feed = feeds_.insert(feeds_.end(), Feed{name, *topic, true, {}, 0, std::nullopt, std::nullopt, 0});
  }
  feed->ros2 = type.empty() || is_ros2_type(type);
  std::erase_if(feed->subscriptions, [&](const RosSubscription& s) { return s.id == subscription.id; });
  feed->sent = 0;
  if (feed->due) {
    feed->due = std::min(*feed->due, *feed->sent_at + std::max(subscription.throttle, least_period_of(topic->what)));
  }
  feed->subscriptions.push_back(std::move(subscription));
  return {};
}

bool RosFeeds::unsubscribe(const std::string& name, const std::string& id) {
  const auto feed = std::find_if(feeds_.begin(), feeds_.end(), [&](const Feed& f) { return f.name == name; });
  if (feed == feeds_.end()) {
    return false;
  }
  const std::size_t gone =
      std::erase_if(feed->subscriptions, [&](const RosSubscription& s) { return id.empty() || s.id == id; });
  return gone > 0;
}

void RosFeeds::send(std::vector<Frame>& frames, Feed& feed, const View& view, const RosMission& mission, Instant now,
                    Duration since_epoch) {
  const std::uint64_t version = version_of(feed.topic.what, view, now);
  if (feed.subscriptions.empty() || version == 0 || version == feed.sent || (feed.due && now < *feed.due)) {
    return;
  }
  const RosStamp stamp{since_epoch, feed.ros2, feed.sequence};
  const std::optional<std::size_t> agent =
      feed.topic.token ? mission.agent_of(*feed.topic.token) : std::optional<std::size_t>();
  const auto publish = [&](auto&& writer, bool binary) {
    if (write_publication(writer, feed.name, feed.topic.what, agent, view, mission, stamp)) {
      frames.push_back({writer.take(), binary});
      ++feed.sequence;
    }
  };
  const auto cbor = [](const RosSubscription& s) { return s.cbor; };
  if (std::any_of(feed.subscriptions.begin(), feed.subscriptions.end(), cbor)) {
    publish(CborWriter(), true);
  } else {
    publish(JsonWriter(), false);
  }
  Duration period = feed.subscriptions.front().throttle;
  for (const RosSubscription& subscription : feed.subscriptions) {
    period = std::min(period, subscription.throttle);
  }
  feed.sent = version;
  feed.sent_at = now;
  feed.due = now + std::max(period, least_period_of(feed.topic.what));
}

void RosFeeds::forget(std::vector<std::string>& unknown, const RosMission* mission, Instant now) {
  std::erase_if(feeds_, [&](const Feed& feed) {
    if (feed.subscriptions.empty()) {
      return !feed.sent_at || now >= *feed.sent_at + least_period_of(feed.topic.what);
    }
    const bool nobody = mission != nullptr && feed.topic.token && !mission->agent_of(*feed.topic.token);
    if (nobody) {
      unknown.push_back(feed.name);
    }
    return nobody;
  });
}

void RosFeeds::take(std::vector<Frame>& frames, std::vector<std::string>& unknown, const View& view,
                    const RosMission* mission, Instant now, Duration since_epoch) {
  static const RosMission kNoMission;
  forget(unknown, mission, now);
  const std::size_t first = std::exchange(next_, 0);
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < feeds_.size(); ++i) {
    const std::size_t at = (first + i) % feeds_.size();
    if (bytes >= kMostBytes) {
      next_ = at;
      return;
    }
    Feed& feed = feeds_[at];
    if (mission != nullptr || feed.topic.what == Outgoing::kState || feed.topic.what == Outgoing::kDiagnostics) {
      const std::size_t before = frames.size();
      send(frames, feed, view, mission == nullptr ? kNoMission : *mission, now, since_epoch);
      bytes += frames.size() > before ? frames.back().bytes.size() : 0;
    }
  }
}

}  // namespace ivo::firmware::web
