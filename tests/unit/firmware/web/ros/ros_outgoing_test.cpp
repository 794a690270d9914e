#include <gtest/gtest.h>

#include "tests/unit/firmware/web/ros/ros_bench.hpp"

namespace ivo::firmware::web {
namespace {

Json subscribed(RosBench& bench, const std::string& topic, const std::string& type = "") {
  const std::string given = type.empty() ? "" : R"(,"type":")" + type + "\"";
  bench.hear(R"({"op":"subscribe","topic":")" + topic + "\"" + given + "}");
  const Json message = bench.only();
  EXPECT_EQ(RosBench::text(message, "op"), "publish");
  EXPECT_EQ(RosBench::text(message, "topic"), topic);
  return within(message, "msg");
}

using Numbers = std::vector<double>;

TEST(RosTopics, TheMapIsAnOccupancyGridInTheFrameOfRos) {
  RosBench bench;
  const Json grid = subscribed(bench, "/ivo/map");
  EXPECT_EQ(numbers_in(within(grid, "data")), (Numbers{0, 0, 0, 100, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(within(grid, "info.width").count, 4U);
  EXPECT_EQ(within(grid, "info.height").count, 3U);
  EXPECT_EQ(within(grid, "info.resolution").real, 0.5);
  EXPECT_EQ(within(grid, "info.origin.position.x").real, 10.0);
  EXPECT_EQ(within(grid, "info.origin.position.y").real, 20.0);
  EXPECT_EQ(within(grid, "info.origin.orientation.w").real, 1.0);
  EXPECT_EQ(within(grid, "header.frame_id").text, "map");
}

TEST(RosTopics, StampsHaveTheFormThatTheTypeAsksFor) {
  RosBench bench;
  const Json ros2 = subscribed(bench, "/ivo/map", "nav_msgs/msg/OccupancyGrid");
  EXPECT_EQ(within(ros2, "header.stamp.sec").count, 1'000'100U);
  EXPECT_EQ(within(ros2, "header.stamp.nanosec").count, 0U);
  EXPECT_EQ(within(ros2, "header").member("seq"), nullptr);
  const Json ros1 = subscribed(bench, "/ivo/probability", "nav_msgs/OccupancyGrid");
  EXPECT_EQ(within(ros1, "header.stamp.secs").count, 1'000'100U);
  EXPECT_EQ(within(ros1, "header.seq").count, 0U);
}

TEST(RosTopics, ProbabilityIsScaledByItsGreatestAndTheMassesAreExact) {
  RosBench bench;
  EXPECT_EQ(numbers_in(within(subscribed(bench, "/ivo/probability"), "data")), (Numbers{100, 50, 50, 0}));
  const Json masses = subscribed(bench, "/ivo/probability/mass");
  EXPECT_EQ(numbers_in(within(masses, "data")), (Numbers{0.5, 0.25, 0.25, 0}));
  EXPECT_EQ(within(masses, "layout.dim").elements.front().member("label")->text, "rows");
  EXPECT_EQ(within(masses, "layout.dim").elements.front().member("stride")->count, 4U);
}

TEST(RosTopics, BeliefIsWhatIsLeftWhereNobodyHasLooked) {
  RosBench bench;
  bench.put(console::Document::kSearched, std::string(1, '\x01'));
  EXPECT_EQ(numbers_in(within(subscribed(bench, "/ivo/belief"), "data")), (Numbers{0, 100, 100, 0}));
  EXPECT_EQ(numbers_in(within(subscribed(bench, "/ivo/belief/mass"), "data")), (Numbers{0, 0.5, 0.5, 0}));
  bench.put(console::Document::kSearched, std::string(1, '\x0f'));
  bench.now += std::chrono::seconds(1);
  const std::vector<Json> both = bench.take();
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(numbers_in(within(both[0], "msg.data")), (Numbers{0, 0, 0, 0}));
  EXPECT_EQ(numbers_in(within(both[1], "msg.data")), (Numbers{0, 0, 0, 0}));
}

TEST(RosTopics, NoGoIsTheMapWithItsNoGoAreas) {
  RosBench bench;
  EXPECT_EQ(numbers_in(within(subscribed(bench, "/ivo/no_go"), "data")),
            (Numbers{100, 100, 0, 100, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(RosTopics, PlansArePathsThatLookAhead) {
  RosBench bench;
  EXPECT_TRUE(within(subscribed(bench, "/ivo/plan"), "poses").elements.empty());
  bench.put(console::Document::kPlan,
            R"({"number":1,"agents":[{"waypoints_m":[[1,1],[1,2]]},{"waypoints_m":[[0,0],[1,0],[1,1]]}]})");
  const Json robot = within(bench.only(), "msg");
  ASSERT_EQ(within(robot, "poses").elements.size(), 2U);
  const Json& first = within(robot, "poses").elements.front();
  EXPECT_EQ(within(first, "pose.position.x").real, 11.0);
  EXPECT_EQ(within(first, "pose.position.y").real, 21.0);
  EXPECT_NEAR(within(first, "pose.orientation.z").real, 0.7071, 1e-4);
  EXPECT_NEAR(within(robot, "poses").elements.back().member("pose")->member("orientation")->member("z")->real, 0.7071,
              1e-4);
  EXPECT_EQ(within(subscribed(bench, "/ivo/plan/Ana_B"), "poses").elements.size(), 3U);
}

TEST(RosTopics, PosesAndTheTransformComeWithEachStatus) {
  RosBench bench;
  const Json pose = subscribed(bench, "/ivo/pose/IVO", "geometry_msgs/PoseStamped");
  EXPECT_EQ(within(pose, "pose.position.x").real, 11.0);
  EXPECT_EQ(within(pose, "pose.position.y").real, 20.5);
  EXPECT_NEAR(within(pose, "pose.orientation.z").real, 0.7071, 1e-4);
  EXPECT_TRUE(bench.take().empty());
  bench.tell(*bench.view.status);
  EXPECT_EQ(bench.take().size(), 1U);
  const Json transform = within(subscribed(bench, "/tf"), "transforms").elements.front();
  EXPECT_EQ(within(transform, "header.frame_id").text, "map");
  EXPECT_EQ(within(transform, "child_frame_id").text, "base_link");
  EXPECT_EQ(within(transform, "transform.translation.x").real, 11.0);
}

TEST(RosTopics, AreasAreMarkersThatReplaceAllBefore) {
  RosBench bench;
  const Json markers = within(subscribed(bench, "/ivo/areas"), "markers");
  ASSERT_EQ(markers.elements.size(), 2U);
  EXPECT_EQ(within(markers.elements[0], "action").count, 3U);
  EXPECT_EQ(within(markers.elements[1], "ns").text, "no_go");
  EXPECT_EQ(within(markers.elements[1], "points").elements.size(), 5U);
  EXPECT_EQ(within(markers.elements[1], "points").elements[1].member("x")->real, 10.9);
}

TEST(RosTopics, TheStateIsTheModeOrWhyThereIsNone) {
  RosBench bench;
  EXPECT_EQ(within(subscribed(bench, "/ivo/state"), "data").text, "awaiting consent");
  EXPECT_TRUE(bench.take().empty());
  bench.view.link = LinkState::kSilent;
  EXPECT_EQ(within(bench.only(), "msg.data").text, "controller silent");
}

TEST(RosTopics, DiagnosticsComeOnceASecondAndSayTheFault) {
  RosBench bench;
  EXPECT_EQ(within(subscribed(bench, "/diagnostics"), "status").elements.front().member("level")->count, 0U);
  bench.now += std::chrono::milliseconds(900);
  EXPECT_TRUE(bench.take().empty());
  bench.now += std::chrono::milliseconds(100);
  std::strcpy(bench.view.status->fault.data(), "wheel 3 is stuck");
  const Json status = within(bench.only(), "msg.status").elements.front();
  EXPECT_EQ(within(status, "level").count, 2U);
  EXPECT_EQ(within(status, "message").text, "wheel 3 is stuck");
  EXPECT_EQ(within(status, "hardware_id").text, "garden");
}

TEST(RosTopics, NothingIsSentThatIsNotThereYetButTheState) {
  View nothing;
  ToldCommands commands;
  RosSession session(nothing, commands);
  for (const std::string topic : {"/ivo/map", "/ivo/plan/Ana", "/ivo/pose/Ana", "/ivo/areas", "/tf", "/ivo/state"}) {
    session.hear(R"({"op":"subscribe","topic":")" + topic + "\"}", false, Instant{});
  }
  const std::vector<Frame> frames = session.take(Instant{});
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames.front().bytes, R"({"op":"publish","topic":"/ivo/state","msg":{"data":"no controller yet"}})");
}

TEST(RosTopics, GridsThatAreNotOfTheMissionsSizeAreNotSent) {
  RosBench bench;
  bench.put(console::Document::kMap, "short");
  bench.hear(R"({"op":"subscribe","topic":"/ivo/map"})");
  EXPECT_TRUE(bench.take().empty());
}

TEST(RosTopics, AgentsHaveTokensThatTopicsMayHave) {
  EXPECT_EQ(topic_token("Ana B."), "Ana_B");
  EXPECT_EQ(topic_token("2nd robot"), "agent_2nd_robot");
  EXPECT_EQ(topic_token("--"), "agent");
  EXPECT_EQ(topic_token("Zo\xc3\xab"), "Zo");
  const auto mission = mission_of(
      R"({"name":"m","map":{"width_px":1,"height_px":1,"resolution_m":1},"cells":{"columns":1,"rows":1,"cell_m":1},
          "classes":[{"obstacle":false}],
          "agents":[{"name":"a b","kind":"robot"},{"name":"a-b","kind":"person"},{"name":"a.b","kind":"person"}]})");
  ASSERT_TRUE(mission);
  EXPECT_EQ(mission->agents[1].token, "a_b_2");
  EXPECT_EQ(mission->agents[2].token, "a_b_3");
  EXPECT_EQ(mission->origin_m, Point{});
}

}  // namespace
}  // namespace ivo::firmware::web
