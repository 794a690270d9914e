#include "firmware/web/status_json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string_view>

#include "firmware/files/json_value.hpp"
#include "firmware/web/compact_json.hpp"
#include "firmware/web/fault_kind.hpp"

namespace ivo::firmware::web {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

Json parsed_status(const View& view, const Desk& desk, Instant now) {
  Result<Json> json = parse_strict_json(status_text(common_status(view, desk, now), true, 7), "status", "a status");
  EXPECT_TRUE(json.ok()) << common_status(view, desk, now);
  return json.ok() ? json.value() : Json();
}

View view_with(const console::Status& status) {
  View view;
  view.link = LinkState::kConnected;
  view.heard_at = Instant(10s);
  view.status = status;
  return view;
}

TEST(StatusText, SaysWhatIsKnown) {
  console::Status status;
  status.mode = 2;
  status.asks = console::Asks::kConsent;
  status.question = 4;
  status.at_ns = 1'500'000'000;
  status.agents = 2;
  status.agent[1] = {
      .x_m = 1.0, .y_m = 2.5, .moved_m = 3.0, .left_m = 4.0, .path_ended = 1, .reported = 1, .report_age_s = 0.5};
  status.searched_mass = 0.25;
  status.pause_cause = 2;
  const Json json = parsed_status(view_with(status), {}, Instant(10s) + 250ms);
  EXPECT_EQ(json.member("controller")->text, "connected");
  EXPECT_EQ(json.member("controller_age_s")->real, 0.25);
  EXPECT_EQ(json.member("time_s")->real, 1.5);
  EXPECT_EQ(json.member("mode")->text, "awaiting consent");
  EXPECT_EQ(json.member("asks")->text, "consent");
  EXPECT_EQ(json.member("question")->count, 4U);
  EXPECT_EQ(json.member("pause_cause")->text, "beat_lost");
  EXPECT_EQ(json.member("search")->member("finder")->kind, Json::Kind::kNull);
  EXPECT_EQ(json.member("search")->member("searched")->real, 0.25);
  const Json& agents = *json.member("agents");
  ASSERT_EQ(agents.elements.size(), 2U);
  EXPECT_EQ(agents.elements[0].member("report_age_s")->kind, Json::Kind::kNull);
  EXPECT_EQ(agents.elements[1].member("report_age_s")->real, 0.5);
  EXPECT_TRUE(agents.elements[1].member("path_ended")->flag);
  EXPECT_EQ(json.member("operator")->kind, Json::Kind::kNull);
  EXPECT_TRUE(json.member("start_fresh")->flag);
  EXPECT_EQ(json.member("n")->count, 7U);
}

TEST(StatusText, SaysWhoIsThereAndWhatWasRefused) {
  Desk desk;
  desk.holder = 3;
  desk.requester = 4;
  desk.screens = {{.screen = 3, .name = "Ana's \"tablet\"", .ros = false}, {.screen = 4, .name = "rviz", .ros = true}};
  desk.refusals.count(Verdict::kReplayed);
  desk.refusals.count_foreign_origin();
  const Json json = parsed_status({}, desk, Instant(1s));
  EXPECT_EQ(json.member("controller")->text, "none");
  EXPECT_EQ(json.member("mode"), nullptr);
  EXPECT_EQ(json.member("operator")->member("name")->text, "Ana's \"tablet\"");
  EXPECT_EQ(json.member("request")->member("screen")->count, 4U);
  EXPECT_EQ(json.member("screens")->elements[1].member("kind")->text, "ros");
  EXPECT_EQ(json.member("refused")->member("replayed")->count, 1U);
  EXPECT_EQ(json.member("refused")->member("foreign_origin")->count, 1U);
  EXPECT_EQ(json.member("refused")->member("malformed")->count, 0U);
}

TEST(StatusText, NamesAHolderWhoHasGone) {
  Desk desk;
  desk.holder = 3;
  EXPECT_EQ(parsed_status({}, desk, Instant(1s)).member("operator")->member("screen")->count, 3U);
}

TEST(StatusText, StaysTextWhateverTheControllerSays) {
  console::Status status;
  status.mode = 200;
  status.search = 200;
  status.stop_cause = 200;
  status.fault.fill('\xff');
  status.fault.back() = '\0';
  status.expected_time_s = std::numeric_limits<double>::quiet_NaN();
  const Json json = parsed_status(view_with(status), {}, Instant(10s));
  EXPECT_EQ(json.member("mode")->text, "unknown");
  EXPECT_EQ(json.member("search")->member("state")->text, "unknown");
}

TEST(CompactJson, WritesWhatReadsBack) {
  CompactJson json;
  json.open('{').key("a").open('[').count(1).number(0.1).null().flag(true).close(']');
  json.key("b").open('{').close('}').key("c").text("\"\\\n\x01 \xc3\xa9 \xff \xed\xa0\x80").close('}');
  EXPECT_EQ(json.written(), "{\"a\":[1,0.1,null,true],\"b\":{},\"c\":\"\\\"\\\\\\u000a\\u0001 \xc3\xa9 ? ???\"}");
  EXPECT_EQ(CompactJson().number(std::numeric_limits<double>::infinity()).written(), "null");
}

TEST(Messages, AreAsTheProtocolSays) {
  EXPECT_EQ(hello_text(3, "Ana", true), R"({"type":"hello","protocol":1,"screen":3,"name":"Ana","may_operate":true})");
  EXPECT_EQ(answer_text(5, Verdict::kOutOfOrder), R"({"type":"answer","seq":5,"verdict":"out_of_order"})");
  EXPECT_EQ(document_text("plan", 7, ""), R"({"type":"document","name":"plan","revision":7,"value":null})");
  EXPECT_EQ(document_text("areas", 8, R"({"areas":[]})"),
            R"({"type":"document","name":"areas","revision":8,"value":{"areas":[]}})");
  EXPECT_EQ(grid_text("map", 1), R"({"type":"grid","name":"map","revision":1})");
  EXPECT_EQ(error_text("wrong_code", "left", 4), R"({"error":"wrong_code","left":4})");
  const Layer pose{.name = LayerName::kRobotPose, .at = Instant(1s), .points = {{1, 2}}, .heading_rad = 0.5};
  EXPECT_EQ(layer_text(pose, Instant(1s) + 100ms),
            R"({"type":"layer","name":"robot_pose","age_s":0.1,"points_m":[[1,2]],"heading_rad":0.5})");
}

TEST(Verdicts, HaveNames) {
  EXPECT_EQ(name_of(Verdict::kAccepted), "accepted");
  EXPECT_EQ(name_of(Verdict::kOtherQuestion), "other_question");
  EXPECT_EQ(name_of(Verdict::kNotAnArea), "not_an_area");
  for (int i = 0; i < console::kVerdicts; ++i) {
    EXPECT_FALSE(name_of(verdict_of(static_cast<console::Verdict>(i))).empty());
  }
}

TEST(StatusText, SaysWhereToLookWhenThereIsAFault) {
  console::Status status;
  Json json = parsed_status(view_with(status), {}, Instant(10s));
  EXPECT_EQ(json.member("fault_kind")->text, "none");
  EXPECT_EQ(json.member("fault_wheel")->kind, Json::Kind::kNull);
  status.fault_reason = static_cast<std::uint8_t>(drivers::DriveFaultReason::kRebooted);
  status.fault_node_id = 3;
  status.fault_wheel = 2;
  json = parsed_status(view_with(status), {}, Instant(10s));
  EXPECT_EQ(json.member("fault_kind")->text, "drive");
  EXPECT_EQ(json.member("fault_wheel")->text, "rear_left");
  status.fault_reason = 200;
  status.fault_wheel = 4;
  json = parsed_status(view_with(status), {}, Instant(10s));
  EXPECT_EQ(json.member("fault_kind")->text, "unknown");
  EXPECT_EQ(json.member("fault_wheel")->text, "unknown");
}

// A person without the page's words for a kind would read its name.
TEST(FaultKind, OfEveryReasonIsOneThatThePageHasWordsFor) {
  const std::set<std::string_view> words{"start_up", "drive",  "silent",   "power",     "wheel",
                                         "slip",     "wiring", "computer", "stop_input"};
  for (int reason = 1; reason <= static_cast<int>(drivers::DriveFaultReason::kFrameRefused); ++reason) {
    EXPECT_TRUE(words.contains(fault_kind(static_cast<drivers::DriveFaultReason>(reason)))) << reason;
  }
}

}  // namespace
}  // namespace ivo::firmware::web
