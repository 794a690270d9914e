// A ROS client that may say anything: what comes of it is in range, what is sent back is well formed, and there is an
// end to both. The input is messages set off by line breaks; a byte before each says how much time passes.
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "firmware/files/json_value.hpp"
#include "firmware/files/polygon_checks.hpp"
#include "firmware/web/ros/ros_session.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo;
using namespace ivo::firmware;
using namespace ivo::firmware::web;
using fuzz::require;

constexpr std::size_t kFuzzAgents = 2;

void put_document(View& view, console::Document which, std::string bytes) {
  KnownDocument& document = view.documents[static_cast<std::size_t>(which) - 1];
  document.revision += 1;
  document.bytes = std::make_shared<const std::string>(std::move(bytes));
}

View small_view() {
  View view;
  view.link = LinkState::kConnected;
  view.statuses = 1;
  view.status.emplace();
  view.status->agents = kFuzzAgents;
  view.status->accepted = 1;
  view.status->asks = console::Asks::kConsent;
  put_document(view, console::Document::kMission,
               R"({"name":"m","map":{"width_px":2,"height_px":2,"resolution_m":1,"origin_m":[5,5]},
                   "cells":{"columns":1,"rows":1,"cell_m":2},"classes":[{"obstacle":false}],
                   "agents":[{"name":"R","kind":"robot"},{"name":"P","kind":"person"}]})");
  put_document(view, console::Document::kMap, std::string(4, '\0'));
  put_document(view, console::Document::kProbability, std::string("\0\0\x80\x3f", 4));
  put_document(view, console::Document::kSearched, std::string(1, '\0'));
  put_document(view, console::Document::kAreas, R"({"areas":[]})");
  put_document(view, console::Document::kPlan, "");
  return view;
}

bool finite(Point p) { return std::isfinite(p.x_m) && std::isfinite(p.y_m); }

struct JudgedCommands final : RosCommands {
  std::uint32_t ask(const Request& request) override {
    if (const auto* position = std::get_if<Position>(&request)) {
      require(position->agent < kFuzzAgents && finite(position->pose.point()), "an agent is somewhere");
      require(std::isfinite(position->pose.heading_rad), "and looks somewhere");
      require(position->sigma_m >= 0 && position->sigma_heading_rad >= 0, "spreads are not negative");
      require(position->age_s >= 0 && position->age_s <= 10, "an age is in range");
    } else if (const auto* area = std::get_if<PutArea>(&request)) {
      require(area->slot < console::kAreaSlots, "a slot is one");
      require(area->agent < kFuzzAgents || area->agent == console::AreaCommand::kEverybody, "an area is somebody's");
      require(area->polygon.size() >= 3 && area->polygon.size() <= console::kAreaCorners, "corners are in range");
    } else if (const auto* gone = std::get_if<RemoveArea>(&request)) {
      require(gone->slot < console::kAreaSlots, "a slot is one");
    } else if (const auto* found = std::get_if<Found>(&request)) {
      require(found->agent < kFuzzAgents, "somebody has found it");
    }
    return ++asked;
  }
  void show(const Layer& layer) override {
    require(layer.points.size() <= Layer::kMostPoints, "a layer has an end");
    for (const Point p : layer.points) {
      require(finite(p), "its points are somewhere");
    }
  }
  [[nodiscard]] bool may_operate() const override { return true; }
  void refused(Verdict verdict) override { require(verdict != Verdict::kAccepted, "what is refused is not accepted"); }
  std::uint32_t asked = 0;
};

void judge(const std::vector<Frame>& frames) {
  require(frames.size() <= RosSession::kMostFrames + 2 * RosFeeds::kMost, "answers have an end");
  for (const Frame& frame : frames) {
    require(frame.binary || parse_json(frame.bytes, "frame", "JSON").ok(), "what is sent as text is JSON");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const View view = small_view();
  JudgedCommands commands;
  RosSession session(view, commands, std::chrono::seconds(1000));
  Instant now{};
  std::string_view left(reinterpret_cast<const char*>(data), size);
  std::uint32_t answered = 0;
  while (!left.empty()) {
    now += std::chrono::milliseconds(static_cast<unsigned char>(left.front()) * 50);
    left.remove_prefix(1);
    const std::size_t end = std::min(left.find('\n'), left.size());
    session.hear(left.substr(0, end), false, now);
    left.remove_prefix(std::min(end + 1, left.size()));
    judge(session.take(now));
    while (answered < commands.asked) {
      ++answered;
      session.answered(answered, static_cast<Verdict>(answered % kVerdicts));
    }
  }
  judge(session.take(now + std::chrono::seconds(20)));
  return 0;
}
