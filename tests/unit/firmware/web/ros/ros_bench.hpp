// A ROS client's session with a small mission: 4 x 3 pixels of half a metre, 2 x 2 cells of a metre, a robot and a
// person, the map's corner at (10, 20) in the frame of ROS.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/files/json_value.hpp"
#include "firmware/web/ros/ros_session.hpp"

namespace ivo::firmware::web {

struct ToldCommands final : RosCommands {
  std::uint32_t ask(const Request& request) override {
    requests.push_back(request);
    return static_cast<std::uint32_t>(requests.size());
  }
  void show(const Layer& layer) override { layers.push_back(layer); }
  [[nodiscard]] bool may_operate() const override { return an_operators; }
  void refused(Verdict verdict) override { refusals.push_back(verdict); }

  std::vector<Request> requests;
  std::vector<Layer> layers;
  std::vector<Verdict> refusals;
  bool an_operators = true;
};

struct RosBench {
  RosBench() {
    put(console::Document::kMission,
        R"({"name":"garden","map":{"width_px":4,"height_px":3,"resolution_m":0.5,"origin_m":[10,20]},
            "cells":{"columns":2,"rows":2,"cell_m":1},
            "classes":[{"name":"pavement","obstacle":false},{"name":"wall","obstacle":true}],
            "agents":[{"name":"IVO","kind":"robot"},{"name":"Ana B.","kind":"person"}]})");
    put(console::Document::kMap, std::string("\0\0\0\1\0\0\0\0\0\0\0\0", 12));
    const float masses[] = {0.5F, 0.25F, 0.25F, 0.0F};
    std::string bytes(sizeof masses, '\0');
    std::memcpy(bytes.data(), masses, sizeof masses);
    put(console::Document::kProbability, bytes);
    put(console::Document::kSearched, std::string(1, '\0'));
    put(console::Document::kAreas,
        R"({"areas":[{"slot":0,"purpose":"no_go","agent":null,"polygon_m":[[0,0],[0.9,0],[0.9,0.4],[0,0.4]]}]})");
    put(console::Document::kPlan, "");
    console::Status status;
    status.agents = 2;
    status.agent[0].x_m = 1.0;
    status.agent[0].y_m = 0.5;
    status.heading_rad = 1.5707963267948966;
    status.agent[1].x_m = 0.25;
    status.plan_number = 7;
    status.areas_revision = 9;
    status.question = 3;
    status.mode = 2;
    view.link = LinkState::kConnected;
    tell(status);
  }

  void put(console::Document which, std::string bytes) {
    view.documents[static_cast<std::size_t>(which) - 1] = {++revision,
                                                           std::make_shared<const std::string>(std::move(bytes))};
  }
  void tell(const console::Status& status) {
    view.status = status;
    ++view.statuses;
  }
  void hear(const std::string& message) { session.hear(message, false, now); }
  /// All that is sent now, parsed.
  std::vector<Json> take() {
    std::vector<Json> messages;
    for (const Frame& frame : session.take(now)) {
      EXPECT_FALSE(frame.binary);
      const Result<Json> json = parse_json(frame.bytes, "frame", "JSON");
      EXPECT_TRUE(json.ok()) << frame.bytes;
      messages.push_back(json.ok() ? json.value() : Json());
    }
    return messages;
  }
  /// The only message that is sent now; null when there is another number of them.
  Json only() {
    std::vector<Json> messages = take();
    EXPECT_EQ(messages.size(), 1U);
    return messages.size() == 1 ? messages.front() : Json();
  }
  /// The text of the only status message that is sent now.
  std::string complaint() {
    const Json message = only();
    EXPECT_EQ(text(message, "op"), "status");
    EXPECT_EQ(text(message, "level"), "error");
    return text(message, "msg");
  }
  void publish(const std::string& topic, const std::string& message) {
    hear(R"({"op":"publish","topic":")" + topic + R"(","msg":)" + message + "}");
  }
  /// What a publication is refused for.
  std::string complaint_about(const std::string& topic, const std::string& message) {
    publish(topic, message);
    EXPECT_TRUE(commands.requests.empty());
    EXPECT_TRUE(commands.layers.empty());
    return complaint();
  }

  static std::string text(const Json& json, std::string_view key) {
    const Json* const value = json.member(key);
    return value != nullptr && value->kind == Json::Kind::kText ? value->text : "";
  }

  View view;
  ToldCommands commands;
  std::uint32_t revision = 0;
  Instant now{std::chrono::seconds(100)};
  RosSession session{view, commands, std::chrono::seconds(1'000'000)};
};

/// A value within objects: "info.origin.position.x".
inline const Json& within(const Json& json, std::string_view path) {
  static const Json kNothing;
  const Json* here = &json;
  while (here != nullptr && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    here = here->member(path.substr(0, dot));
    path = path.substr(std::min(dot + 1, path.size()));
  }
  EXPECT_NE(here, nullptr);
  return here == nullptr ? kNothing : *here;
}

inline std::vector<double> numbers_in(const Json& list) {
  std::vector<double> numbers;
  for (const Json& element : list.elements) {
    numbers.push_back(element.real);
  }
  return numbers;
}

}  // namespace ivo::firmware::web
