#include "firmware/web/ros/ros_services.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/firmware/web/ros/ros_bench.hpp"

namespace ivo::firmware::web {
namespace {

void call(RosBench& bench, const std::string& service, const std::string& args = "{}") {
  bench.hear(R"({"op":"call_service","id":"c1","service":")" + service + R"(","args":)" + args + "}");
}

/// The values of the only answer.
Json answer(RosBench& bench, bool result = true) {
  const Json message = bench.only();
  EXPECT_EQ(RosBench::text(message, "op"), "service_response");
  EXPECT_EQ(RosBench::text(message, "id"), "c1");
  EXPECT_EQ(within(message, "result").flag, result);
  return within(message, "values");
}

TEST(RosServices, ATriggerIsAnsweredWhenTheControllerHasAnswered) {
  RosBench bench;
  call(bench, "/ivo/init");
  ASSERT_EQ(bench.commands.requests.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<Init>(bench.commands.requests.front()));
  EXPECT_TRUE(bench.take().empty());
  bench.session.answered(1, Verdict::kAccepted);
  const Json values = answer(bench);
  EXPECT_TRUE(within(values, "success").flag);
  bench.session.answered(1, Verdict::kAccepted);
  EXPECT_TRUE(bench.take().empty());
}

TEST(RosServices, ARefusalIsSaidInTheVerdictsWord) {
  RosBench bench;
  call(bench, "/ivo/take_control");
  EXPECT_TRUE(std::holds_alternative<RequestControl>(bench.commands.requests.front()));
  bench.session.answered(1, Verdict::kNotAllowed);
  const Json values = answer(bench);
  EXPECT_FALSE(within(values, "success").flag);
  EXPECT_EQ(within(values, "message").text, "not_allowed");
}

TEST(RosServices, WhatIsAskedForIsWhatIsShownNow) {
  RosBench bench;
  call(bench, "/ivo/replan");
  call(bench, "/ivo/accept");
  call(bench, "/ivo/enough");
  EXPECT_EQ(std::get<Replan>(bench.commands.requests[0]).areas_revision, 9U);
  EXPECT_EQ(std::get<Accept>(bench.commands.requests[1]).plan, 7U);
  EXPECT_EQ(std::get<Enough>(bench.commands.requests[2]).plan, 7U);
}

TEST(RosServices, NothingStartsBeforeThePlanIsAcceptedAndConsentIsAskedFor) {
  RosBench bench;
  call(bench, "/ivo/start");
  EXPECT_EQ(within(answer(bench), "message").text, "the plan is not accepted; expected /ivo/accept first");
  bench.view.status->accepted = 1;
  call(bench, "/ivo/start");
  EXPECT_FALSE(within(answer(bench), "success").flag);
  EXPECT_TRUE(bench.commands.requests.empty());
  bench.view.status->asks = console::Asks::kConsent;
  call(bench, "/ivo/start");
  EXPECT_EQ(std::get<Start>(bench.commands.requests.front()).question, 3U);
}

TEST(RosServices, APlanThatWasJustAcceptedMayStartBeforeAStatusSaysSo) {
  RosBench bench;
  bench.view.status->asks = console::Asks::kConsent;
  call(bench, "/ivo/accept");
  bench.session.answered(1, Verdict::kAccepted);
  (void)answer(bench);
  bench.view.status->plan_number += 1;
  call(bench, "/ivo/start");
  EXPECT_FALSE(within(answer(bench), "success").flag);
  bench.view.status->plan_number -= 1;
  call(bench, "/ivo/start");
  EXPECT_TRUE(std::holds_alternative<Start>(bench.commands.requests.back()));
}

TEST(RosServices, TheFinderIsThePersonUnlessSaid) {
  RosBench bench;
  call(bench, "/ivo/found");
  call(bench, "/ivo/found/IVO");
  EXPECT_EQ(std::get<Found>(bench.commands.requests[0]).agent, 1);
  EXPECT_EQ(std::get<Found>(bench.commands.requests[1]).agent, 0);
  call(bench, "/ivo/found/Eva");
  EXPECT_EQ(answer(bench, false).text,
            "/ivo/found/Eva: names an agent that is not there; expected a service of /rosapi/services");
}

TEST(RosServices, StopNeedsNoStatus) {
  RosBench bench;
  bench.view.status.reset();
  call(bench, "/ivo/stop");
  EXPECT_TRUE(std::holds_alternative<Stop>(bench.commands.requests.front()));
  call(bench, "/ivo/accept");
  EXPECT_EQ(within(answer(bench), "message").text, "the controller was never there; expected one that shows a plan");
}

TEST(RosServices, WhoIsNotAnsweredHearsSoAfterTenSeconds) {
  RosBench bench;
  call(bench, "/ivo/init");
  bench.now += std::chrono::milliseconds(10'001);
  EXPECT_EQ(within(answer(bench), "message").text, "no_controller");
}

TEST(RosServices, UnknownOnesAreRefusedByName) {
  RosBench bench;
  call(bench, "/reboot");
  EXPECT_EQ(answer(bench, false).text, "/reboot: unknown; expected a service of /rosapi/services");
}

TEST(RosServices, RosapiSaysWhatThereIs) {
  RosBench bench;
  call(bench, "/rosapi/topics");
  const Json topics = answer(bench);
  EXPECT_EQ(within(topics, "topics").elements.size(), within(topics, "types").elements.size());
  const auto has = [](const Json& list, const std::string& name) {
    return std::any_of(list.elements.begin(), list.elements.end(), [&](const Json& e) { return e.text == name; });
  };
  EXPECT_TRUE(has(within(topics, "topics"), "/ivo/plan/Ana_B"));
  EXPECT_TRUE(has(within(topics, "topics"), "/ivo/person/Ana_B/pose"));
  call(bench, "/rosapi/topic_type", R"({"topic":"/ivo/plan/IVO"})");
  EXPECT_EQ(within(answer(bench), "type").text, "nav_msgs/Path");
  call(bench, "/rosapi/topics_for_type", R"({"type":"sensor_msgs/msg/LaserScan"})");
  EXPECT_EQ(within(answer(bench), "topics").elements.front().text, "/scan");
  call(bench, "/rosapi/services");
  EXPECT_TRUE(has(within(answer(bench), "services"), "/ivo/found/Ana_B"));
  call(bench, "/rosapi/service_type", R"({"service":"/ivo/start"})");
  EXPECT_EQ(within(answer(bench), "type").text, "std_srvs/Trigger");
  call(bench, "/rosapi/get_time");
  EXPECT_EQ(within(answer(bench), "time.sec").count, 1'000'100U);
  call(bench, "/rosapi/topic_type");
  EXPECT_EQ(answer(bench, false).text, "/rosapi/topic_type: args: topic: missing; expected a text");
}

}  // namespace
}  // namespace ivo::firmware::web
