#include "firmware/web/ros/ros_session.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <variant>

#include "firmware/files/json_reading.hpp"
#include "firmware/web/ros/json_writer.hpp"
#include "firmware/web/ros/ros_incoming.hpp"
#include "firmware/web/ros/ros_request.hpp"
#include "firmware/web/ros/ros_services.hpp"

namespace ivo::firmware::web {
namespace {

// By then the controller has said which areas there are.
constexpr Duration kClaim = std::chrono::seconds(2);

const Json kNoArguments = Json::of(Json::Kind::kObject);

std::string quoted_text(std::string_view text) {
  JsonWriter writer;
  writer.text(text);
  return writer.take();
}

/// The message's id as JSON again; empty without one, none when it is no id.
std::optional<std::string> id_of(const Json& message) {
  const Json* const id = message.member("id");
  if (id == nullptr || id->kind == Json::Kind::kNull) {
    return "";
  }
  if (id->kind == Json::Kind::kCount) {
    return std::to_string(id->count);
  }
  const bool fits = id->kind == Json::Kind::kText && id->text.size() <= RosSession::kMostName;
  return fits ? std::optional<std::string>(quoted_text(id->text)) : std::nullopt;
}

/// A member that is a text of at most kMostName bytes; empty when it is missing. A fault says what it is instead.
std::string name_in(JsonReading& reading, const Json& message, const char* key, bool required) {
  if (message.member(key) == nullptr && !required) {
    return {};
  }
  std::string name = reading.text(message, "", key);
  if (name.size() > RosSession::kMostName || (required && name.empty())) {
    reading.fault(
        key, "has " + std::to_string(name.size()) + " bytes; expected 1 to " + std::to_string(RosSession::kMostName));
    return {};
  }
  return name;
}

bool right_type(const Topic<Incoming>& topic, const std::string& type) {
  const std::string given = short_type(type);
  return given == topic.type || (is_button(topic.what) && given == "std_msgs/Bool") ||
         (topic.what == Incoming::kRemoveArea && given == "std_msgs/Int32");
}

}  // namespace

const RosMission* RosSession::mission() {
  if (view_.connections != connections_) {
    connections_ = view_.connections;
    accepted_plan_ = 0;
  }
  const KnownDocument& document = view_.document(console::Document::kMission);
  if (document.revision != mission_revision_) {
    mission_revision_ = document.revision;
    mission_ = document.there() ? mission_of(*document.bytes) : std::nullopt;
  }
  return mission_ ? &*mission_ : nullptr;
}

void RosSession::put(std::string text) {
  if (frames_.size() >= kMostFrames || frame_bytes_ + text.size() > kMostFrameBytes) {
    ++dropped_;
    return;
  }
  frame_bytes_ += text.size();
  frames_.push_back({std::move(text), false});
}

void RosSession::say(StatusLevel level, const std::string& id, const std::string& text) {
  if (level > level_) {
    return;
  }
  JsonWriter writer;
  writer.begin_object();
  writer.add("op", "status");
  if (!id.empty()) {
    writer.key("id");
    writer.raw(id);
  }
  writer.add("level", level == StatusLevel::kError ? "error" : level == StatusLevel::kWarning ? "warning" : "info");
  writer.add("msg", text).end_object();
  put(writer.take());
}

void RosSession::refuse(const std::string& id, std::string_view about, std::string_view what,
                        std::optional<Verdict> verdict) {
  ++refused_;
  if (verdict) {
    commands_.refused(*verdict);
  }
  say(StatusLevel::kError, id, std::string(about).append(about.empty() ? "" : ": ").append(what));
}

void RosSession::respond(const std::string& id, const std::string& service, bool result, std::string_view values) {
  JsonWriter writer;
  writer.begin_object();
  writer.add("op", "service_response");
  if (!id.empty()) {
    writer.key("id");
    writer.raw(id);
  }
  writer.add("service", service).key("values");
  writer.raw(values);
  writer.add("result", result).end_object();
  put(writer.take());
}

bool RosSession::comes_too_often(std::string_view message, Instant now) {
  if (pace_.may_say(message.size(), now)) {
    return false;
  }
  // Whatever else a client says: that it wants the robot to stand is heard.
  const bool perhaps = message.size() <= RosPace::kShortBytes && message.find("stop") != std::string_view::npos;
  if (!perhaps || !pace_.may_stop(now)) {
    return true;
  }
  const Result<Json> json = parse_json(message, "message", "an operation of rosbridge");
  const Json* const op = json ? json.value().member("op") : nullptr;
  const Json* const service = json ? json.value().member("service") : nullptr;
  const std::optional<RosTrigger> trigger = service != nullptr ? trigger_named(service->text) : std::nullopt;
  return op == nullptr || op->text != "call_service" || !trigger || trigger->what != RosAsk::kStop;
}

void RosSession::hear(std::string_view message, bool binary, Instant now) {
  if (comes_too_often(message, now)) {
    refuse("", "", "too often; expected at most 400 messages and 16 MiB a second", Verdict::kTooOften);
    return;
  }
  if (binary) {
    refuse("", "", "a binary message; expected JSON, CBOR goes to clients alone");
    return;
  }
  if (message.size() > kMostBytes) {
    refuse("", "", "a message of " + std::to_string(message.size()) + " bytes; expected at most 4 MiB",
           Verdict::kTooLarge);
    return;
  }
  if (static_cast<std::size_t>(std::count(message.begin(), message.end(), ',')) > kMostValues) {
    refuse("", "", "a message of more than 300000 values; expected bytes as base64", Verdict::kTooLarge);
    return;
  }
  const Result<Json> json = parse_json(message, "message", "an operation of rosbridge");
  if (!json) {
    refuse("", "", json.error().message);
    return;
  }
  const Json* const op = json.value().member("op");
  if (op == nullptr || op->kind != Json::Kind::kText || op->text.size() > kMostName) {
    refuse("", "op", "is missing or no text; expected an operation of rosbridge");
    return;
  }
  const std::optional<std::string> id = id_of(json.value());
  if (!id) {
    refuse("", "id", "will not do; expected a text of at most 256 bytes or a whole number");
    return;
  }
  hear_operation(op->text, json.value(), *id, now);
}

void RosSession::hear_operation(const std::string& op, const Json& message, const std::string& id, Instant now) {
  if (op == "publish") {
    hear_publish(message, id, now);
  } else if (op == "subscribe") {
    hear_subscribe(message, id);
  } else if (op == "unsubscribe") {
    hear_unsubscribe(message, id);
  } else if (op == "advertise" || op == "unadvertise") {
    hear_advertise(message, id);
  } else if (op == "call_service") {
    hear_call(message, id, now);
  } else if (op == "set_level" || op == "status_level") {
    hear_level(message, id);
  } else if (op == "auth") {
    say(StatusLevel::kWarning, id, "auth: not needed; the token is part of the address");
  } else if (op == "fragment" || op == "png") {
    refuse(id, op, "parts are not put together here; expected whole messages");
  } else {
    refuse(id, op,
           "not known here; expected advertise, unadvertise, publish, subscribe, unsubscribe, call_service or "
           "set_level");
  }
}

void RosSession::hear_level(const Json& message, const std::string& id) {
  JsonReading reading("set_level");
  constexpr std::array<const char*, 4> kLevels = {"none", "error", "warning", "info"};
  const std::size_t level = reading.choice(message, "", "level", kLevels);
  if (!reading.ok()) {
    refuse(id, "", reading.error().message);
    return;
  }
  level_ = static_cast<StatusLevel>(level);
}

void RosSession::hear_advertise(const Json& message, const std::string& id) {
  JsonReading reading("advertise");
  const std::string name = name_in(reading, message, "topic", true);
  const std::string type = name_in(reading, message, "type", false);
  if (!reading.ok()) {
    refuse(id, "", reading.error().message);
    return;
  }
  const std::optional<Topic<Incoming>> topic = incoming_topic(name);
  if (!topic) {
    refuse(id, name, "unknown; expected a topic of /rosapi/topics that is taken in");
  } else if (!type.empty() && !right_type(*topic, type)) {
    refuse(id, name, "type: " + type + " is not this topic's; expected " + std::string(topic->type));
  }
}

void RosSession::hear_publish(const Json& message, const std::string& id, Instant now) {
  JsonReading reading("publish");
  const std::string name = name_in(reading, message, "topic", true);
  const Json* const inner = message.member("msg");
  if (!reading.ok()) {
    refuse(id, "", reading.error().message);
    return;
  }
  const std::optional<Topic<Incoming>> topic = incoming_topic(name);
  if (!topic) {
    refuse(id, name, "unknown; expected a topic of /rosapi/topics that is taken in");
    return;
  }
  if (topic->what == Incoming::kRobotPose && !commands_.may_operate()) {
    refuse(id, name, "not_allowed: comes with a viewer's token; expected an operator's", Verdict::kNotAllowed);
    return;
  }
  const RosMission* const known = mission();
  if (known == nullptr) {
    refuse(id, name, "the mission is not known yet; expected a controller that is there");
    return;
  }
  RosSetting setting{view_, *known, 0, accepted_plan_, now, now.time_since_epoch() + epoch_};
  for (std::size_t slot = 0; slot < claimed_until_.size(); ++slot) {
    setting.claimed_slots |= now < claimed_until_[slot] ? 1U << slot : 0U;
  }
  const Result<RosHeard> heard = heard_of(*topic, inner == nullptr ? kNoArguments : *inner, setting);
  if (!heard) {
    refuse(id, name, heard.error().message);
    return;
  }
  if (heard.value().layer) {
    commands_.show(*heard.value().layer);
  }
  if (heard.value().request && pace_.worth_asking(*heard.value().request, now)) {
    ask(*heard.value().request, id, name, false, now);
  }
}

void RosSession::hear_subscribe(const Json& message, const std::string& id) {
  constexpr double kMostThrottle_ms = 3'600'000;
  JsonReading reading("subscribe");
  const std::string name = name_in(reading, message, "topic", true);
  const std::string type = name_in(reading, message, "type", false);
  const std::string compression = name_in(reading, message, "compression", false);
  double throttle_ms = 0.0;
  if (message.member("throttle_rate") != nullptr) {
    throttle_ms = reading.number(message, "", "throttle_rate", 0.0, kMostThrottle_ms);
  }
  // Only the newest value matters of what is given out; a queue of any length holds it.
  if (message.member("queue_length") != nullptr) {
    (void)reading.number(message, "", "queue_length", 0.0, 1e6);
  }
  if (!compression.empty() && compression != "none" && compression != "cbor") {
    reading.fault("compression", "\"" + compression + "\" is not known here; expected \"none\" or \"cbor\"");
  }
  if (!reading.ok()) {
    refuse(id, "", reading.error().message);
    return;
  }
  const Result<void> subscribed =
      feeds_.subscribe(name, type, {id, from_seconds(throttle_ms / 1e3), compression == "cbor"}, mission());
  if (!subscribed) {
    refuse(id, name, subscribed.error().message);
  }
}

void RosSession::hear_unsubscribe(const Json& message, const std::string& id) {
  JsonReading reading("unsubscribe");
  const std::string name = name_in(reading, message, "topic", true);
  if (!reading.ok()) {
    refuse(id, "", reading.error().message);
  } else if (!feeds_.unsubscribe(name, id)) {
    say(StatusLevel::kWarning, id, name + ": was not subscribed to");
  }
}

void RosSession::hear_call(const Json& message, const std::string& id, Instant now) {
  JsonReading reading("call_service");
  const std::string name = name_in(reading, message, "service", true);
  const std::string type = name_in(reading, message, "type", false);
  if (!reading.ok()) {
    refuse(id, "", reading.error().message);
    return;
  }
  const auto fail = [&](const std::string& why) {
    ++refused_;
    commands_.refused(Verdict::kMalformed);
    respond(id, name, false, quoted_text(name + ": " + why));
  };
  const RosMission* const known = mission();
  if (is_rosapi(name)) {
    const Json* const args = message.member("args");
    JsonWriter values;
    const RosStamp stamp{now.time_since_epoch() + epoch_, type.empty() || is_ros2_type(type), 0};
    const Result<void> written = write_rosapi(values, name, args == nullptr ? kNoArguments : *args, known, stamp);
    return written ? respond(id, name, true, values.take()) : fail(written.error().message);
  }
  const std::optional<RosTrigger> trigger = trigger_named(name);
  if (!trigger) {
    return fail("unknown; expected a service of /rosapi/services");
  }
  if (trigger->what == RosAsk::kStop) {
    return ask(Stop{}, id, name, true, now);  // whatever is known
  }
  if (known == nullptr) {
    return fail("the mission is not known yet; expected a controller that is there");
  }
  const std::optional<std::size_t> agent =
      trigger->token ? known->agent_of(*trigger->token) : std::optional<std::size_t>();
  if (trigger->token && !agent) {
    return fail("names an agent that is not there; expected a service of /rosapi/services");
  }
  const Result<Request> request = ros_request(trigger->what, agent, view_, *known, accepted_plan_);
  if (!request) {
    ++refused_;
    commands_.refused(Verdict::kMalformed);
    JsonWriter values;
    values.begin_object();
    values.add("success", false).add("message", request.error().message).end_object();
    return respond(id, name, true, values.take());
  }
  ask(request.value(), id, name, true, now);
}

void RosSession::ask(const Request& request, const std::string& id, const std::string& name, bool service,
                     Instant now) {
  Pending pending{0, id, name, service, now, 0};
  if (const auto* accept = std::get_if<Accept>(&request)) {
    pending.plan = accept->plan;
  }
  if (pending_.size() >= kMostPending && !std::holds_alternative<Stop>(request)) {
    commands_.refused(Verdict::kTooOften);
    finish(pending, Verdict::kTooOften);
    return;
  }
  if (const auto* put_area = std::get_if<PutArea>(&request)) {
    claimed_until_[put_area->slot] = now + kClaim;
  }
  pending.ask = commands_.ask(request);
  pending_.push_back(std::move(pending));
}

void RosSession::answered(std::uint32_t ask, Verdict verdict) {
  const auto found = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& p) { return p.ask == ask; });
  if (found != pending_.end()) {
    const Pending pending = std::move(*found);
    pending_.erase(found);
    finish(pending, verdict);
  }
}

void RosSession::finish(const Pending& pending, Verdict verdict) {
  const std::string word(name_of(verdict));
  const bool accepted = verdict == Verdict::kAccepted;
  accepted_plan_ = accepted && pending.plan != 0 ? pending.plan : accepted_plan_;
  if (pending.service) {
    refused_ += accepted ? 0 : 1;
    JsonWriter values;
    values.begin_object();
    values.add("success", accepted).add("message", word).end_object();
    respond(pending.id, pending.name, true, values.take());
  } else if (!accepted) {
    refuse(pending.id, pending.name, word, std::nullopt);
  }
}

std::vector<Frame> RosSession::take(Instant now) {
  while (!pending_.empty() && now - pending_.front().at > kPatience) {
    const Pending late = std::move(pending_.front());
    pending_.erase(pending_.begin());
    finish(late, Verdict::kNoController);
  }
  std::vector<std::string> unknown;
  std::vector<Frame> publications;
  feeds_.take(publications, unknown, view_, mission(), now, now.time_since_epoch() + epoch_);
  for (const std::string& name : unknown) {
    refuse("", name, "names an agent that is not there; expected one of /rosapi/topics");
  }
  std::vector<Frame> frames = std::exchange(frames_, {});
  frame_bytes_ = 0;
  std::move(publications.begin(), publications.end(), std::back_inserter(frames));
  return frames;
}

}  // namespace ivo::firmware::web
