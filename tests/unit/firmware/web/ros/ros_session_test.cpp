#include "firmware/web/ros/ros_session.hpp"

#include <gtest/gtest.h>

#include "tests/unit/firmware/web/ros/ros_bench.hpp"

namespace ivo::firmware::web {
namespace {

TEST(RosSession, ASubscriberHasTheNewestValueAtOnceAndThenWhatIsNew) {
  RosBench bench;
  bench.hear(R"({"op":"subscribe","id":"a","topic":"/ivo/map","type":"nav_msgs/OccupancyGrid"})");
  EXPECT_EQ(bench.take().size(), 1U);
  EXPECT_TRUE(bench.take().empty());
  bench.put(console::Document::kMap, std::string(12, '\1'));
  EXPECT_EQ(bench.take().size(), 1U);
  bench.hear(R"({"op":"subscribe","id":"b","topic":"/ivo/map"})");
  EXPECT_EQ(bench.take().size(), 1U);
}

TEST(RosSession, AThrottledTopicWaitsAndThenHasTheNewestValueAlone) {
  RosBench bench;
  bench.hear(R"({"op":"subscribe","topic":"/ivo/pose/IVO","throttle_rate":500,"queue_length":1})");
  EXPECT_EQ(bench.take().size(), 1U);
  for (int i = 0; i < 9; ++i) {
    bench.now += std::chrono::milliseconds(50);
    bench.view.status->agent[0].x_m = i;
    bench.tell(*bench.view.status);
    EXPECT_TRUE(bench.take().empty());
  }
  bench.now += std::chrono::milliseconds(50);
  EXPECT_EQ(within(bench.only(), "msg.pose.position.x").real, 18.0);
}

TEST(RosSession, TwoSubscriptionsToATopicAreServedOnceByTheMoreImpatient) {
  RosBench bench;
  bench.hear(R"({"op":"subscribe","id":"slow","topic":"/ivo/pose/IVO","throttle_rate":5000})");
  bench.hear(R"({"op":"subscribe","id":"quick","topic":"/ivo/pose/IVO"})");
  EXPECT_EQ(bench.take().size(), 1U);
  bench.tell(*bench.view.status);
  EXPECT_EQ(bench.take().size(), 1U);
  bench.hear(R"({"op":"unsubscribe","id":"quick","topic":"/ivo/pose/IVO"})");
  bench.tell(*bench.view.status);
  EXPECT_EQ(bench.take().size(), 1U);
  bench.tell(*bench.view.status);
  EXPECT_TRUE(bench.take().empty());
  bench.hear(R"({"op":"unsubscribe","topic":"/ivo/pose/IVO"})");
  bench.now += std::chrono::seconds(9);
  EXPECT_TRUE(bench.take().empty());
}

TEST(RosSession, GridsComeAsTypedArraysToWhoAsksForCbor) {
  RosBench bench;
  bench.hear(R"({"op":"subscribe","topic":"/ivo/probability","compression":"cbor"})");
  const std::vector<Frame> frames = bench.session.take(bench.now);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_TRUE(frames.front().binary);
  EXPECT_EQ(frames.front().bytes.substr(0, 13), "\xBF\x62op\x67publish\x65");
  // Tag 72, a byte string of four.
  EXPECT_NE(frames.front().bytes.find(std::string("data\xD8\x48\x44\x64\x32\x32\0\xFF", 12)), std::string::npos);
}

TEST(RosSession, UnknownTopicsTypesAndAgentsAreRefusedByName) {
  RosBench bench;
  bench.hear(R"({"op":"subscribe","topic":"/cmd_vel"})");
  EXPECT_EQ(bench.complaint(), "/cmd_vel: unknown; expected a topic of /rosapi/topics that is given out");
  bench.hear(R"({"op":"subscribe","topic":"/ivo/map","type":"nav_msgs/msg/Path"})");
  EXPECT_EQ(bench.complaint(),
            "/ivo/map: type: nav_msgs/msg/Path is not this topic's; expected nav_msgs/OccupancyGrid");
  bench.hear(R"({"op":"subscribe","topic":"/ivo/pose/Eva"})");
  EXPECT_EQ(bench.complaint(), "/ivo/pose/Eva: names an agent that is not there; expected one of /rosapi/topics");
  bench.hear(R"({"op":"subscribe","topic":"/ivo/map","compression":"png"})");
  EXPECT_EQ(bench.complaint(), "subscribe: compression: \"png\" is not known here; expected \"none\" or \"cbor\"");
  bench.hear(R"({"op":"advertise","topic":"/ivo/map","type":"nav_msgs/OccupancyGrid"})");
  EXPECT_EQ(bench.complaint(), "/ivo/map: unknown; expected a topic of /rosapi/topics that is taken in");
  bench.hear(R"({"op":"advertise","topic":"/scan","type":"std_msgs/Empty"})");
  EXPECT_EQ(bench.complaint(), "/scan: type: std_msgs/Empty is not this topic's; expected sensor_msgs/LaserScan");
  EXPECT_EQ(bench.session.refused(), 6U);
}

TEST(RosSession, OperationsThatAreNoneAreRefusedWithTheirId) {
  RosBench bench;
  bench.hear(R"({"op":"fragment","id":"f1","data":"x","num":0,"total":1})");
  const Json status = bench.only();
  EXPECT_EQ(within(status, "id").text, "f1");
  EXPECT_EQ(within(status, "msg").text, "fragment: parts are not put together here; expected whole messages");
  bench.hear(R"({"op":"service_response","id":5,"service":"/ivo/init","result":true})");
  EXPECT_EQ(within(bench.only(), "id").count, 5U);
  bench.hear("{}");
  EXPECT_EQ(bench.complaint(), "op: is missing or no text; expected an operation of rosbridge");
  bench.hear("[1,");
  EXPECT_EQ(bench.complaint(), "message:1: not JSON: ends too early; expected an operation of rosbridge");
  bench.hear("{\"op\":\xE1\n}");
  EXPECT_EQ(bench.complaint(), "message:1: not JSON: \"??}\" cannot stand here; expected an operation of rosbridge");
  bench.hear(R"({"op":"subscribe","topic":7})");
  EXPECT_EQ(bench.complaint(), "subscribe: topic: is no text; expected text");
  bench.hear(R"({"op":"subscribe","id":[1],"topic":"/tf"})");
  EXPECT_EQ(bench.complaint(), "id: will not do; expected a text of at most 256 bytes or a whole number");
  bench.session.hear("\xBF\xFF", true, bench.now);
  EXPECT_EQ(bench.complaint(), "a binary message; expected JSON, CBOR goes to clients alone");
}

TEST(RosSession, WhatIsTooLargeTooLongOrTooMuchIsRefused) {
  RosBench bench;
  bench.hear(std::string(RosSession::kMostBytes + 1, ' '));
  EXPECT_EQ(bench.complaint(), "a message of 4194305 bytes; expected at most 4 MiB");
  bench.hear("[" + std::string(RosSession::kMostValues + 1, ',') + "]");
  EXPECT_EQ(bench.complaint(), "a message of more than 300000 values; expected bytes as base64");
  bench.hear(R"({"op":"subscribe","topic":")" + std::string(257, 'a') + "\"}");
  EXPECT_EQ(bench.complaint(), "subscribe: topic: has 257 bytes; expected 1 to 256");
  for (std::size_t i = 0; i <= RosFeeds::kMost; ++i) {
    bench.hear(R"({"op":"subscribe","topic":"/ivo/state","id":)" + std::to_string(i) + "}");
  }
  const std::vector<Json> messages = bench.take();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(within(messages[0], "msg").text, "/ivo/state: is one too many; expected at most 64 subscriptions");
}

TEST(RosSession, AFloodIsRefusedUntilTheSecondIsOver) {
  RosBench bench;
  bench.hear(R"({"op":"set_level","level":"none"})");
  for (int i = 0; i < 1000; ++i) {
    bench.publish("/ivo/button/init", "{}");
  }
  EXPECT_EQ(bench.commands.requests.size(), RosSession::kMostPending);
  EXPECT_TRUE(bench.take().empty());
  bench.now += std::chrono::seconds(11);
  (void)bench.take();
  bench.publish("/ivo/button/init", "{}");
  EXPECT_EQ(bench.commands.requests.size(), RosSession::kMostPending + 1);
}

TEST(RosSession, StatusesAreSaidDownToTheLevelThatWasAskedFor) {
  RosBench bench;
  bench.hear(R"({"op":"unsubscribe","topic":"/tf"})");
  EXPECT_TRUE(bench.take().empty());
  bench.hear(R"({"op":"set_level","level":"warning"})");
  bench.hear(R"({"op":"unsubscribe","topic":"/tf"})");
  EXPECT_EQ(within(bench.only(), "level").text, "warning");
  bench.hear(R"({"op":"set_level","level":"none"})");
  bench.hear(R"({"op":"subscribe","topic":"/nothing"})");
  EXPECT_TRUE(bench.take().empty());
  bench.hear(R"({"op":"set_level","level":"loud"})");
  EXPECT_EQ(bench.session.refused(), 2U);
}

TEST(RosSession, AMissionThatComesLaterGivesUpTopicsOfStrangers) {
  RosBench bench;
  const KnownDocument mission = bench.view.document(console::Document::kMission);
  bench.view.documents[0] = {};
  bench.hear(R"({"op":"subscribe","topic":"/ivo/pose/Eva"})");
  bench.hear(R"({"op":"subscribe","topic":"/ivo/pose/IVO"})");
  EXPECT_TRUE(bench.take().empty());
  bench.view.documents[0] = mission;
  const std::vector<Json> messages = bench.take();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(within(messages[0], "msg").text,
            "/ivo/pose/Eva: names an agent that is not there; expected one of "
            "/rosapi/topics");
  EXPECT_EQ(within(messages[1], "topic").text, "/ivo/pose/IVO");
}

}  // namespace
}  // namespace ivo::firmware::web
