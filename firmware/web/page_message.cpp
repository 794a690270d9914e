#include "firmware/web/page_message.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "firmware/files/json_value.hpp"

namespace ivo::firmware::web {
namespace {

using Asked = std::optional<Request>;

/// The members of one message: each is to be taken once, and none to be left.
class Keys {
 public:
  explicit Keys(const Json& object) : object_(object) {}

  [[nodiscard]] bool right() const { return right_ && taken_ == object_.members.size(); }

  std::uint32_t count(const char* key, std::uint64_t most = std::numeric_limits<std::uint32_t>::max()) {
    const Json* const value = take(key);
    right_ = right_ && value != nullptr && value->kind == Json::Kind::kCount && value->count <= most;
    return right_ ? static_cast<std::uint32_t>(value->count) : 0;
  }
  std::uint8_t byte(const char* key, std::uint64_t most) { return static_cast<std::uint8_t>(count(key, most)); }
  double number(const char* key) { return number(take(key)); }
  std::string text(const char* key) {
    const Json* const value = take(key);
    right_ = right_ && value != nullptr && value->kind == Json::Kind::kText;
    return right_ ? value->text : "";
  }
  /// An agent's index, or null for everybody.
  std::uint8_t agent_or_all(const char* key) {
    const Json* const value = object_.member(key);
    if (value != nullptr && value->kind == Json::Kind::kNull) {
      ++taken_;
      return console::AreaCommand::kEverybody;
    }
    return byte(key, console::kAgents - 1);
  }
  std::vector<Point> polygon(const char* key) {
    const Json* const value = take(key);
    right_ = right_ && value != nullptr && value->kind == Json::Kind::kList && value->elements.size() >= 3 &&
             value->elements.size() <= console::kAreaCorners;
    std::vector<Point> corners;
    for (std::size_t i = 0; right_ && i < value->elements.size(); ++i) {
      const Json& corner = value->elements[i];
      right_ = corner.kind == Json::Kind::kList && corner.elements.size() == 2;
      if (right_) {
        const double x_m = number(&corner.elements[0]);
        corners.push_back({x_m, number(&corner.elements[1])});
      }
    }
    return corners;
  }
  void wrong() { right_ = false; }

 private:
  const Json* take(const char* key) {
    const Json* const value = object_.member(key);
    taken_ += value != nullptr ? 1 : 0;
    return value;
  }
  double number(const Json* value) {
    right_ = right_ && value != nullptr && value->is_number() && std::isfinite(value->real);
    return right_ ? value->real : 0.0;
  }

  const Json& object_;
  std::size_t taken_ = 0;
  bool right_ = true;
};

PutArea area_of(Keys& keys) {
  PutArea area;
  area.slot = keys.byte("slot", console::kAreaSlots - 1);
  const std::string purpose = keys.text("purpose");
  area.purpose = purpose == "no_go" ? console::AreaPurpose::kNoGo : console::AreaPurpose::kPreferred;
  area.agent = keys.agent_or_all("agent");
  area.polygon = keys.polygon("polygon_m");
  const bool nobodys =
      area.agent == console::AreaCommand::kEverybody && area.purpose == console::AreaPurpose::kPreferred;
  if ((purpose != "no_go" && purpose != "preferred") || nobodys) {
    keys.wrong();
  }
  return area;
}

Asked request_of(const std::string& what, Keys& keys) {
  if (what == "beat") return Beat{keys.count("seen")};
  if (what == "stop") return Stop{};
  if (what == "end") return End{};
  if (what == "init") return Init{};
  if (what == "replan") return Replan{keys.count("areas_revision")};
  if (what == "enough") return Enough{keys.count("plan")};
  if (what == "accept") return Accept{keys.count("plan")};
  if (what == "start") {
    Start start;
    start.question = keys.count("question");
    start.seen = keys.count("seen");
    return start;
  }
  if (what == "clear_fault") return ClearFault{keys.count("question")};
  if (what == "found") return Found{keys.byte("agent", console::kAgents - 1)};
  if (what == "position") {
    Position position;
    position.agent = keys.byte("agent", console::kAgents - 1);
    position.pose.x_m = keys.number("x_m");
    position.pose.y_m = keys.number("y_m");
    return position;
  }
  if (what == "area.put") return area_of(keys);
  if (what == "area.remove") return RemoveArea{keys.byte("slot", console::kAreaSlots - 1)};
  if (what == "control.request") return RequestControl{};
  if (what == "control.give") return GiveControl{};
  if (what == "control.keep") return KeepControl{};
  if (what == "control.release") return ReleaseControl{};
  return std::nullopt;
}

}  // namespace

PageMessage page_message(std::string_view text) {
  PageMessage message;
  if (text.size() > PageMessage::kLongest) {
    message.verdict = Verdict::kTooLarge;
    return message;
  }
  const Result<Json> json = parse_strict_json(text, "a page", "an object");
  if (!json || json.value().kind != Json::Kind::kObject) {
    return message;
  }
  Keys keys(json.value());
  message.sequence = keys.count("seq");
  const std::string what = keys.text("do");
  Asked asked = request_of(what, keys);
  if (asked && keys.right() && message.sequence != 0) {
    message.verdict = Verdict::kAccepted;
    message.request = std::move(*asked);
  }
  return message;
}

}  // namespace ivo::firmware::web
