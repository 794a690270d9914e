#include "firmware/console/console_desk.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace ivo::firmware::console {
namespace {

class ConsoleDeskTest : public testing::Test {
 protected:
  Verdict submit(Kind kind, std::uint32_t question = 0) {
    return desk_.submit(Command{.header = {.kind = kind}, .question = question});
  }
  std::optional<Kind> take(Asks asks) {
    const std::optional<DeskAnswer> answer = desk_.take(asks);
    return answer ? std::optional(answer->kind) : std::nullopt;
  }
  std::uint32_t question() const { return desk_.status().question; }
  void ask(Asks asks) { desk_.show({}, asks); }

  int stops_ = 0;
  ConsoleDesk desk_{
      {.agents = 2, .width_m = 20, .height_m = 10}, {}, {.stop = [this] { ++stops_; }, .pause = [] {}, .beat = [] {}}};
};

TEST_F(ConsoleDeskTest, TakesAPingAtAnyTimeAndChangesNothing) {
  EXPECT_EQ(submit(Kind::kPing), Verdict::kAccepted);
  ask(Asks::kConsent);
  EXPECT_EQ(submit(Kind::kPing, 99), Verdict::kAccepted);
  EXPECT_EQ(take(Asks::kConsent), std::nullopt);
  EXPECT_EQ(stops_, 0);
}

TEST_F(ConsoleDeskTest, StopsAtOnceWhateverIsAsked) {
  int expected = 0;
  for (const Asks asks : {Asks::kNothing, Asks::kConsent, Asks::kClearing}) {
    ask(asks);
    EXPECT_EQ(submit(Kind::kStop, 1234), Verdict::kAccepted);
    EXPECT_EQ(stops_, ++expected);
  }
}

TEST_F(ConsoleDeskTest, TakesOnlyTheAnswersThatFitTheQuestion) {
  struct Row {
    Asks asks;
    Kind kind;
    bool fits;
  };
  for (const Row& row : {Row{Asks::kNothing, Kind::kConsent, false}, Row{Asks::kNothing, Kind::kNoConsent, false},
                         Row{Asks::kNothing, Kind::kClearFault, false}, Row{Asks::kConsent, Kind::kConsent, true},
                         Row{Asks::kConsent, Kind::kNoConsent, true}, Row{Asks::kConsent, Kind::kClearFault, false},
                         Row{Asks::kClearing, Kind::kConsent, false}, Row{Asks::kClearing, Kind::kNoConsent, true},
                         Row{Asks::kClearing, Kind::kClearFault, true}}) {
    ask(Asks::kNothing);
    ask(row.asks);
    EXPECT_EQ(submit(row.kind, question()), row.fits ? Verdict::kAccepted : Verdict::kNotAsked);
    EXPECT_EQ(take(row.asks), row.fits ? std::optional(row.kind) : std::nullopt);
    EXPECT_EQ(take(row.asks), std::nullopt) << "once";
  }
}

TEST_F(ConsoleDeskTest, RefusesConsentToWhatWasAskedBefore) {
  ask(Asks::kConsent);
  const std::uint32_t first = question();
  ask(Asks::kClearing);
  ask(Asks::kConsent);
  EXPECT_EQ(submit(Kind::kConsent, first), Verdict::kOtherQuestion);
  EXPECT_EQ(submit(Kind::kConsent, question() + 1), Verdict::kOtherQuestion);
  EXPECT_EQ(submit(Kind::kConsent, 0), Verdict::kOtherQuestion);
  EXPECT_EQ(take(Asks::kConsent), std::nullopt);
  EXPECT_EQ(submit(Kind::kConsent, question()), Verdict::kAccepted);
}

TEST_F(ConsoleDeskTest, HearsTheFirstAnswerAlone) {
  ask(Asks::kConsent);
  EXPECT_EQ(submit(Kind::kNoConsent, question()), Verdict::kAccepted);
  EXPECT_EQ(submit(Kind::kConsent, question()), Verdict::kAnswered);
  EXPECT_EQ(take(Asks::kConsent), Kind::kNoConsent);
  EXPECT_EQ(submit(Kind::kConsent, question()), Verdict::kAnswered) << "taken, and the question still stands";
  EXPECT_EQ(take(Asks::kConsent), std::nullopt);
}

TEST_F(ConsoleDeskTest, ForgetsAnAnswerThatNobodyTookWhenSomethingElseIsAsked) {
  ask(Asks::kConsent);
  EXPECT_EQ(submit(Kind::kConsent, question()), Verdict::kAccepted);
  EXPECT_EQ(take(Asks::kClearing), std::nullopt);
  ask(Asks::kNothing);
  ask(Asks::kConsent);
  EXPECT_EQ(take(Asks::kConsent), std::nullopt);
}

TEST_F(ConsoleDeskTest, NumbersQuestionsAndNotStatuses) {
  EXPECT_EQ(question(), 0U);
  for (int i = 0; i < 5; ++i) {
    ask(Asks::kConsent);
  }
  EXPECT_EQ(question(), 1U);
  ask(Asks::kNothing);
  EXPECT_EQ(question(), 1U);
  ask(Asks::kConsent);
  EXPECT_EQ(question(), 2U);
}

TEST_F(ConsoleDeskTest, ShowsTheNewestStatus) {
  Status status;
  status.cycles = 7;
  desk_.show(status, Asks::kNothing);
  status.cycles = 8;
  desk_.show(status, Asks::kClearing);
  EXPECT_EQ(desk_.status().cycles, 8U);
  EXPECT_EQ(desk_.status().asks, Asks::kClearing);
}

}  // namespace
}  // namespace ivo::firmware::console
