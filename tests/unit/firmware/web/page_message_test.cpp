#include "firmware/web/page_message.hpp"

#include <gtest/gtest.h>

#include "firmware/web/page_check.hpp"

namespace ivo::firmware::web {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

template <class T>
T read(std::string_view text) {
  const PageMessage message = page_message(text);
  EXPECT_EQ(message.verdict, Verdict::kAccepted) << text;
  EXPECT_EQ(message.sequence, 7U);
  return std::get<T>(message.request);
}

bool malformed(std::string_view text) { return page_message(text).verdict == Verdict::kMalformed; }

TEST(PageMessage, SaysWhatIsAskedFor) {
  (void)read<Beat>(R"({"seq":7,"do":"beat"})");
  (void)read<Stop>(R"( { "do" : "stop", "seq" : 7 } )");
  (void)read<End>(R"({"seq":7,"do":"end"})");
  (void)read<Init>(R"({"seq":7,"do":"init"})");
  (void)read<RequestControl>(R"({"seq":7,"do":"control.request"})");
  (void)read<GiveControl>(R"({"seq":7,"do":"control.give"})");
  (void)read<KeepControl>(R"({"seq":7,"do":"control.keep"})");
  (void)read<ReleaseControl>(R"({"seq":7,"do":"control.release"})");
  EXPECT_EQ(read<Replan>(R"({"seq":7,"do":"replan","areas_revision":4294967295})").areas_revision, 4294967295U);
  EXPECT_EQ(read<Enough>(R"({"seq":7,"do":"enough","plan":2})").plan, 2U);
  EXPECT_EQ(read<Accept>(R"({"seq":7,"do":"accept","plan":3})").plan, 3U);
  EXPECT_EQ(read<Start>(R"({"seq":7,"do":"start","question":4})").question, 4U);
  EXPECT_EQ(read<ClearFault>(R"({"seq":7,"do":"clear_fault","question":5})").question, 5U);
  EXPECT_EQ(read<Found>(R"({"seq":7,"do":"found","agent":1})").agent, 1);
  EXPECT_EQ(read<RemoveArea>(R"({"seq":7,"do":"area.remove","slot":31})").slot, 31);
}

TEST(PageMessage, SaysWhereAPersonIs) {
  const auto position = read<Position>(R"({"seq":7,"do":"position","agent":1,"x_m":1.5,"y_m":-2})");
  EXPECT_EQ(position.agent, 1);
  EXPECT_EQ(position.pose.point(), (Point{1.5, -2.0}));
  EXPECT_EQ(position.age_s, 0.0);
}

TEST(PageMessage, SaysAnArea) {
  const auto area = read<PutArea>(
      R"({"seq":7,"do":"area.put","slot":3,"purpose":"no_go","agent":null,"polygon_m":[[0,0],[1,0],[1,1.5]]})");
  EXPECT_EQ(area.slot, 3);
  EXPECT_EQ(area.purpose, console::AreaPurpose::kNoGo);
  EXPECT_EQ(area.agent, console::AreaCommand::kEverybody);
  EXPECT_EQ(area.polygon, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1.5}}));
  const auto preferred = read<PutArea>(
      R"({"seq":7,"do":"area.put","slot":0,"purpose":"preferred","agent":2,"polygon_m":[[0,0],[1,0],[1,1]]})");
  EXPECT_EQ(preferred.agent, 2);
}

TEST(PageMessage, IsMalformedWithoutItsKeysOrWithMore) {
  for (const char* text : {"",
                           "null",
                           "[]",
                           "7",
                           "\"beat\"",
                           "{}",
                           R"({"seq":7})",
                           R"({"do":"beat"})",
                           R"({"seq":7,"do":"dance"})",
                           R"({"seq":7,"do":"beat","x":1})",
                           R"({"seq":7,"do":"accept"})",
                           R"({"seq":7,"do":"accept","question":1})",
                           R"({"seq":7,"do":"beat"}x)",
                           R"({"seq":7,"do":"beat")",
                           R"({"seq":7,"do":7})",
                           R"({"seq":"7","do":"beat"})",
                           R"({"seq":7,"seq":7,"do":"beat"})",
                           R"({"seq":7,"do":"beat","do":"beat"})",
                           R"({"seq":0,"do":"beat"})",
                           R"({"seq":-1,"do":"beat"})",
                           R"({"seq":7.0,"do":"beat"})",
                           R"({"seq":4294967296,"do":"beat"})",
                           R"({"seq":7,"do":"found","agent":8})",
                           R"({"seq":7,"do":"found","agent":null})",
                           R"({"seq":7,"do":"area.remove","slot":32})",
                           R"({"seq":7,"do":"position","agent":1,"x_m":"1","y_m":0})",
                           R"({"seq":7,"do":"position","agent":1,"x_m":1e999,"y_m":0})",
                           R"({"seq":7,"do":"position","agent":1,"x_m":NaN,"y_m":0})"}) {
    EXPECT_TRUE(malformed(text)) << text;
  }
  EXPECT_TRUE(malformed(std::string_view("{\"seq\":7,\"do\":\"be\0at\"}", 22)));
  EXPECT_TRUE(malformed(std::string(5000, '[')));
}

TEST(PageMessage, IsMalformedWithAnAreaThatIsNone) {
  const auto area = [](const std::string& polygon, const std::string& rest = R"("purpose":"no_go","agent":null)") {
    return R"({"seq":7,"do":"area.put","slot":0,)" + rest + R"(,"polygon_m":)" + polygon + "}";
  };
  EXPECT_FALSE(malformed(area("[[0,0],[1,0],[1,1]]")));
  for (const char* polygon : {"[]", "[[0,0],[1,0]]", "[[0,0],[1,0],[1]]", "[[0,0],[1,0],[1,1,1]]", "[[0,0],[1,0],null]",
                              "[[0,0],[1,0],[\"1\",1]]", "null", "{}"}) {
    EXPECT_TRUE(malformed(area(polygon))) << polygon;
  }
  std::string corners = "[0,0]";
  for (int i = 1; i < console::kAreaCorners; ++i) {
    corners += ",[0,1]";
  }
  EXPECT_FALSE(malformed(area("[" + corners + "]")));
  EXPECT_TRUE(malformed(area("[" + corners + ",[1,1]]")));
  EXPECT_TRUE(malformed(area("[[0,0],[1,0],[1,1]]", R"("purpose":"preferred","agent":null)")));
  EXPECT_TRUE(malformed(area("[[0,0],[1,0],[1,1]]", R"("purpose":"other","agent":1)")));
}

TEST(PageMessage, IsTooLargeBeyondItsLimit) {
  const std::string text = R"({"seq":7,"do":"beat"})";
  EXPECT_EQ(page_message(text + std::string(PageMessage::kLongest - text.size(), ' ')).verdict, Verdict::kAccepted);
  EXPECT_EQ(page_message(text + std::string(PageMessage::kLongest - text.size() + 1, ' ')).verdict, Verdict::kTooLarge);
}

class PageCheckTest : public testing::Test {
 protected:
  Verdict judge(int sequence, const std::string& what = "beat") {
    return check_.judge("{\"seq\":" + std::to_string(sequence) + ",\"do\":\"" + what + "\"}", now_).verdict;
  }

  Instant now_{100s};
  PageCheck check_;
};

TEST_F(PageCheckTest, TakesEachNumberOnceAndInOrder) {
  EXPECT_EQ(judge(2), Verdict::kOutOfOrder);
  EXPECT_EQ(judge(1), Verdict::kAccepted);
  EXPECT_EQ(judge(1), Verdict::kReplayed);
  EXPECT_EQ(judge(3), Verdict::kOutOfOrder);
  EXPECT_EQ(judge(2), Verdict::kAccepted);
}

TEST_F(PageCheckTest, GoesOnAfterAMessageThatIsWrong) {
  EXPECT_EQ(judge(1, "dance"), Verdict::kMalformed);
  EXPECT_EQ(judge(1), Verdict::kReplayed);
  EXPECT_EQ(judge(2), Verdict::kAccepted);
}

TEST_F(PageCheckTest, TakesFortyASecondButEveryStop) {
  for (int i = 1; i <= PageCheck::kPerSecond; ++i) {
    EXPECT_EQ(judge(i), Verdict::kAccepted);
  }
  EXPECT_EQ(judge(41), Verdict::kTooOften);
  EXPECT_EQ(judge(42, "stop"), Verdict::kAccepted);
  now_ += 25ms;
  EXPECT_EQ(judge(43), Verdict::kAccepted);
  EXPECT_EQ(judge(44), Verdict::kTooOften);
  now_ += 1s;
  for (int i = 45; i < 85; ++i) {
    EXPECT_EQ(judge(i), Verdict::kAccepted);
  }
}

}  // namespace
}  // namespace ivo::firmware::web
