#include "firmware/web/ros/ros_incoming.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/firmware/web/ros/ros_bench.hpp"

namespace ivo::firmware::web {
namespace {

const std::string kSquare =
    R"({"header":{"frame_id":"map"},"polygon":{"points":[{"x":10,"y":20,"z":0},{"x":11,"y":20,"z":0},{"x":11,"y":21}]}})";

std::string identity_pose(const std::string& place) {
  return R"({"position":)" + place + R"(,"orientation":{"x":0,"y":0,"z":0,"w":1}})";
}

std::string localised(const std::string& stamp, const std::string& variance = "0.04") {
  std::string covariance = variance;
  for (int i = 1; i < 36; ++i) {
    covariance += i == 7 ? ",0.09" : i == 35 ? ",0.01" : ",0";
  }
  return R"({"header":{"frame_id":"map","stamp":)" + stamp + R"(},"pose":{"pose":)" +
         identity_pose(R"({"x":11,"y":21,"z":0})") + R"(,"covariance":[)" + covariance + "]}}";
}

TEST(RosIncoming, APreferredAreaGoesIntoTheNextFreeSlotInOurFrame) {
  RosBench bench;
  bench.publish("/ivo/preferred_area/Ana_B", kSquare);
  bench.publish("/ivo/no_go_area", kSquare);
  ASSERT_EQ(bench.commands.requests.size(), 2U);
  const auto& preferred = std::get<PutArea>(bench.commands.requests[0]);
  EXPECT_EQ(preferred.slot, 1);  // 0 is taken
  EXPECT_EQ(preferred.purpose, console::AreaPurpose::kPreferred);
  EXPECT_EQ(preferred.agent, 1);
  EXPECT_EQ(preferred.polygon, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}}));
  const auto& no_go = std::get<PutArea>(bench.commands.requests[1]);
  EXPECT_EQ(no_go.slot, 2);  // 1 was just put
  EXPECT_EQ(no_go.purpose, console::AreaPurpose::kNoGo);
  EXPECT_EQ(no_go.agent, console::AreaCommand::kEverybody);
  bench.publish("/ivo/remove_area", R"({"data":2})");
  EXPECT_EQ(std::get<RemoveArea>(bench.commands.requests[2]).slot, 2);
}

TEST(RosIncoming, WhatTheControllerRefusesIsSaid) {
  RosBench bench;
  bench.hear(R"({"op":"publish","id":"p","topic":"/ivo/no_go_area","msg":)" + kSquare + "}");
  bench.session.answered(1, Verdict::kNotAllowed);
  const Json status = bench.only();
  EXPECT_EQ(within(status, "id").text, "p");
  EXPECT_EQ(within(status, "msg").text, "/ivo/no_go_area: not_allowed");
}

TEST(RosIncoming, AreasThatAreNoneAreRefusedByWhatIsWrong) {
  RosBench bench;
  const std::string topic = "/ivo/no_go_area";
  EXPECT_EQ(bench.complaint_about(topic, R"({"header":{"frame_id":"odom"},"polygon":{"points":[]}})"),
            topic + ": msg: header.frame_id: \"odom\" is another frame; expected \"map\"");
  EXPECT_EQ(bench.complaint_about(topic, R"({"polygon":{"points":[{"x":1,"y":1},{"x":1,"y":2}]}})"),
            topic + ": msg: polygon.points: has 2 points; expected 3 to 64");
  EXPECT_EQ(bench.complaint_about(topic, R"({"polygon":{"points":[{"x":1,"y":1},{"x":1,"y":2},{"x":"a","y":2}]}})"),
            topic + ": msg: polygon.points[2].x: this will not do; expected a number, -1000000 to 1000000");
  EXPECT_EQ(bench.complaint_about(topic, R"({"polygon":{"points":[{"x":0,"y":0},{"x":1,"y":1},{"x":1,"y":0},
                                            {"x":0,"y":1}]}})"),
            topic +
                ": msg: polygon.points: crosses itself: sides 0 and 2 meet; expected a polygon whose sides meet "
                "only at its vertices");
  EXPECT_EQ(bench.complaint_about(topic, "7"), topic + ": msg: is no object; expected a geometry_msgs/PolygonStamped");
  EXPECT_EQ(bench.complaint_about("/ivo/preferred_area/Eva", kSquare),
            "/ivo/preferred_area/Eva: names an agent that is not there; expected one of /rosapi/topics");
  EXPECT_EQ(bench.complaint_about("/ivo/remove_area", R"({"data":32})"),
            "/ivo/remove_area: msg: data: is no count; expected a whole number, 0 to 31");
}

TEST(RosIncoming, APersonIsWhereATrackerSays) {
  RosBench bench;
  bench.publish("/ivo/person/Ana_B/pose", R"({"header":{"frame_id":"","stamp":{"secs":1000099,"nsecs":500000000}},
      "pose":{"position":{"x":10.5,"y":21,"z":0}}})");
  const auto& position = std::get<Position>(bench.commands.requests.front());
  EXPECT_EQ(position.agent, 1);
  EXPECT_EQ(position.pose.point(), (Point{0.5, 1}));
  EXPECT_NEAR(position.age_s, 0.5, 1e-6);
  RosBench other;
  EXPECT_EQ(other.complaint_about("/ivo/person/IVO/pose", "{}"),
            "/ivo/person/IVO/pose: msg: is about a robot; expected a person, of the robot comes /ivo/robot/pose");
}

TEST(RosIncoming, TheRobotsPoseIsShownAndNotSaidToTheController) {
  RosBench bench;
  bench.publish("/ivo/robot/pose", localised(R"({"sec":1000098,"nanosec":0})"));
  EXPECT_TRUE(bench.commands.requests.empty());
  ASSERT_EQ(bench.commands.layers.size(), 1U);
  EXPECT_NEAR(seconds(bench.now - bench.commands.layers.front().at), 2.0, 1e-6);
  EXPECT_EQ(bench.commands.layers.front().name, LayerName::kRobotPose);
  EXPECT_EQ(bench.commands.layers.front().points, (std::vector<Point>{{1, 1}}));
}

TEST(RosIncoming, TheRobotsPoseComesFromWhoMayOperate) {
  RosBench bench;
  bench.commands.an_operators = false;
  EXPECT_EQ(bench.complaint_about("/ivo/robot/pose", localised(R"({"sec":0,"nanosec":0})")),
            "/ivo/robot/pose: not_allowed: comes with a viewer's token; expected an operator's");
  EXPECT_EQ(bench.commands.refusals, (std::vector<Verdict>{Verdict::kNotAllowed}));
}

TEST(RosIncoming, PosesThatAreOldOrNoneAreRefused) {
  RosBench bench;
  const std::string topic = "/ivo/robot/pose";
  EXPECT_EQ(bench.complaint_about(topic, localised(R"({"sec":1000080,"nanosec":0})")),
            topic + ": msg: header.stamp: is 20 s old; expected at most 10, or clocks that agree");
  EXPECT_EQ(bench.complaint_about(topic, localised(R"({"sec":0,"nanosec":0})", "-1")),
            topic + ": msg: covariance[0]: -1 will not do; expected a number, 0 to 1000000000000");
  std::string turned = localised(R"({"sec":0,"nanosec":0})");
  turned.replace(turned.find(R"("w":1)"), 5, R"("w":0)");
  EXPECT_EQ(bench.complaint_about(topic, turned),
            topic + ": msg: pose.pose.orientation.w: belongs to a quaternion of length 0; expected length 1");
  EXPECT_EQ(bench.complaint_about(topic, R"({"pose":{"pose":{},"covariance":[1,2]}})"),
            topic + ": msg: pose.covariance: has 2 entries; expected 36");
}

TEST(RosIncoming, PosesMoreOftenThanAnybodyNeedsArePassedOver) {
  RosBench bench;
  for (int i = 0; i < 100; ++i) {
    bench.publish("/ivo/person/Ana_B/pose", R"({"pose":{"position":{"x":10.5,"y":21,"z":0}}})");
    bench.now += std::chrono::milliseconds(10);
  }
  EXPECT_GE(bench.commands.requests.size(), 10U);
  EXPECT_LE(bench.commands.requests.size(), 12U);
  EXPECT_EQ(bench.session.refused(), 0U);
}

TEST(RosIncoming, AScanIsSeenFromTheRobot) {
  RosBench bench;
  bench.publish(
      "/scan",
      R"({"header":{"frame_id":"base_link"},"angle_min":0,"angle_max":3.15,"angle_increment":1.5707963267948966,
      "range_min":0.1,"range_max":5,"ranges":[2,1,null,9,0.01],"intensities":[]})");
  ASSERT_EQ(bench.commands.layers.size(), 1U);
  const Layer& layer = bench.commands.layers.front();
  EXPECT_EQ(layer.name, LayerName::kScan);
  EXPECT_EQ(layer.at, bench.now);
  ASSERT_EQ(layer.points.size(), 2U);  // the robot stands at (1, 0.5) and looks up
  EXPECT_NEAR(layer.points[0].x_m, 1.0, 1e-9);
  EXPECT_NEAR(layer.points[0].y_m, 2.5, 1e-9);
  EXPECT_NEAR(layer.points[1].x_m, 0.0, 1e-9);
  EXPECT_NEAR(layer.points[1].y_m, 0.5, 1e-9);
}

TEST(RosIncoming, AScanOfAnotherFrameIsRefusedByName) {
  RosBench bench;
  EXPECT_EQ(
      bench.complaint_about("/scan", R"({"header":{"frame_id":"camera"},"angle_min":0,"angle_increment":1,
      "range_min":0,"range_max":1,"ranges":[]})"),
      "/scan: msg: header.frame_id: \"camera\" is another frame; expected one of base_link, base_footprint, laser, "
      "laser_frame, laser_link, base_laser, base_scan");
  bench.view.status.reset();
  EXPECT_EQ(
      bench.complaint_about("/scan", R"({"angle_min":0,"angle_increment":1,"range_min":0,"range_max":1,"ranges":[]})"),
      "/scan: msg: is seen from a robot whose place nobody knows yet; expected a controller that is there");
}

std::string cloud(const std::string& data, const std::string& frame = "map") {
  return R"({"header":{"frame_id":")" + frame +
         R"("},"height":1,"width":2,"is_bigendian":false,"point_step":12,"row_step":24,
      "fields":[{"name":"x","offset":0,"datatype":7,"count":1},{"name":"y","offset":4,"datatype":7,"count":1},
                {"name":"z","offset":8,"datatype":7,"count":1}],"is_dense":true,"data":)" +
         data + "}";
}

TEST(RosIncoming, APointCloudComesAsBase64OrAsNumbers) {
  // (11, 21, 0) and a point that is none: x is no number.
  const std::string base64 = "\"AAAwQQAAqEEAAAAAAADAfwAAqEEAAAAA\"";
  const std::string numbers = "[0,0,48,65,0,0,168,65,0,0,0,0,0,0,192,127,0,0,168,65,0,0,0,0]";
  for (const std::string& data : {base64, numbers}) {
    RosBench bench;
    bench.publish("/points", cloud(data));
    ASSERT_EQ(bench.commands.layers.size(), 1U) << bench.complaint();
    EXPECT_EQ(bench.commands.layers.front().points, (std::vector<Point>{{1, 1}}));
  }
}

TEST(RosIncoming, APointCloudThatDoesNotAddUpIsRefused) {
  RosBench bench;
  EXPECT_EQ(
      bench.complaint_about("/points", cloud("\"AAAA\"")),
      "/points: msg: data: has 3 bytes; expected row_step x height, and a row_step of width x point_step at least");
  EXPECT_EQ(bench.complaint_about("/points", cloud("\"AAA\"")),
            "/points: msg: data: is neither base64 nor a list; expected the points' bytes");
  EXPECT_EQ(bench.complaint_about("/points", cloud("[256]")),
            "/points: msg: data: holds what is no byte; expected numbers of 0 to 255");
  std::string beyond = cloud("\"\"");
  beyond.replace(beyond.find("\"offset\":4"), 10, "\"offset\":9");
  EXPECT_EQ(bench.complaint_about("/points", beyond),
            "/points: msg: fields: y lies beyond point_step; expected it within a point");
}

TEST(RosIncoming, PeopleAreShownWhereTheyAre) {
  RosBench bench;
  bench.publish("/people", R"({"header":{"frame_id":"map"},"poses":[{"position":{"x":10,"y":20,"z":1},
      "orientation":{"x":0,"y":0,"z":0,"w":0}},{"position":{"x":12,"y":21.5,"z":0}}]})");
  ASSERT_EQ(bench.commands.layers.size(), 1U);
  EXPECT_EQ(bench.commands.layers.front().name, LayerName::kPeople);
  EXPECT_EQ(bench.commands.layers.front().points, (std::vector<Point>{{0, 0}, {2, 1.5}}));
}

TEST(RosIncoming, ALayerHoldsSoManyPointsAndNoMore) {
  RosBench bench;
  std::string ranges = "1";
  for (int i = 0; i < 9999; ++i) {
    ranges += ",1";
  }
  bench.publish("/scan",
                R"({"angle_min":0,"angle_increment":0.001,"range_min":0,"range_max":2,"ranges":[)" + ranges + "]}");
  EXPECT_LE(bench.commands.layers.front().points.size(), Layer::kMostPoints);
  EXPECT_GE(bench.commands.layers.front().points.size(), Layer::kMostPoints / 2);
}

TEST(RosIncoming, ButtonsArePressedByEmptyMessagesAndByTrueOnes) {
  RosBench bench;
  bench.publish("/ivo/button/init", "{}");
  bench.publish("/ivo/button/replan", R"({"data":true})");
  bench.publish("/ivo/button/replan", R"({"data":false})");
  bench.publish("/ivo/button/object_found", "{}");
  bench.publish("/ivo/button/object_found/IVO", "{}");
  ASSERT_EQ(bench.commands.requests.size(), 4U);
  EXPECT_TRUE(std::holds_alternative<Init>(bench.commands.requests[0]));
  EXPECT_EQ(std::get<Replan>(bench.commands.requests[1]).areas_revision, 9U);
  EXPECT_EQ(std::get<Found>(bench.commands.requests[2]).agent, 1);
  EXPECT_EQ(std::get<Found>(bench.commands.requests[3]).agent, 0);
  RosBench other;
  EXPECT_EQ(other.complaint_about("/ivo/button/start", "{}"),
            "/ivo/button/start: msg: the plan is not accepted; expected /ivo/accept first");
  EXPECT_EQ(other.complaint_about("/ivo/button/init", R"({"data":"yes"})"),
            "/ivo/button/init: msg: data: is no flag; expected true or false");
}

}  // namespace
}  // namespace ivo::firmware::web
