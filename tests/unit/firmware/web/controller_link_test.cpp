#include "firmware/web/controller_link.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cstring>
#include <limits>
#include <optional>

#include "firmware/console/socket_path.hpp"
#include "firmware/web/requests.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ivo::firmware::web {
namespace {

using console::Kind;
using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

/// A link, and the other end of its socket in the test's hands. Sockets of one machine deliver at once.
class ControllerLinkTest : public testing::Test {
 protected:
  void listen() { listener_.emplace(std::move(console::Listener::at(path_)).value()); }
  void connect() {
    now_ += ControllerLink::kTryAgain;
    link_.turn(now_);
    controller_ = hal::FileDescriptor(::accept(listener_->get(), nullptr, nullptr));
    ASSERT_TRUE(controller_.valid());
  }
  void leave() {
    controller_.close();
    listener_.reset();
    link_.turn(now_);
  }

  template <class Message>
  void say(Message message, Kind kind) {
    message.header.kind = kind;
    message.header.size = sizeof(Message);
    (void)::send(controller_.get(), &message, sizeof(message), MSG_NOSIGNAL);
    link_.turn(now_);
  }
  void say_status(std::uint32_t question = 1) {
    console::Status status;
    status.question = question;
    say(status, Kind::kStatus);
  }
  void say_document(console::Document document, const std::string& text, std::uint32_t revision = 1) {
    console::DocumentPart part;
    part.document = document;
    part.revision = revision;
    part.whole = part.count = static_cast<std::uint32_t>(text.size());
    std::memcpy(part.bytes.data(), text.data(), text.size());
    say(part, Kind::kDocumentPart);
  }
  void answer(std::uint32_t sequence, console::Verdict verdict) {
    say(console::Answer{.header = {}, .of_sequence = sequence, .verdict = verdict}, Kind::kAnswer);
  }
  std::optional<console::Command> heard() const {
    console::Command command;
    const ssize_t size = ::recv(controller_.get(), &command, sizeof(command), MSG_DONTWAIT | MSG_TRUNC);
    return size == sizeof(command) ? std::optional(command) : std::nullopt;
  }
  const View& view() const { return link_.view(); }

  ScratchFolder folder_;
  std::string path_ = folder_.path("controller");
  Instant now_{100s};
  std::optional<console::Listener> listener_;
  hal::FileDescriptor controller_;
  ControllerLink link_{path_};
};

TEST_F(ControllerLinkTest, TriesFourTimesASecondUntilSomebodyIsThere) {
  link_.turn(now_);
  EXPECT_EQ(view().link, LinkState::kNone);
  EXPECT_NE(link_.complaint().find("nobody listens there"), std::string::npos);
  listen();
  link_.turn(now_ + 249ms);
  EXPECT_EQ(::accept(listener_->get(), nullptr, nullptr), -1);
  connect();
  EXPECT_EQ(view().link, LinkState::kNone);  // it has not said anything yet
  say_status();
  EXPECT_EQ(view().link, LinkState::kConnected);
  EXPECT_EQ(view().connections, 1U);
  EXPECT_TRUE(link_.complaint().empty());
}

TEST_F(ControllerLinkTest, NumbersWhatItSaysAndHearsTheAnswers) {
  listen();
  EXPECT_FALSE(link_.say(Init{}, now_).has_value());
  connect();
  say_status();
  EXPECT_EQ(link_.say(Replan{7}, now_), 1U);
  EXPECT_EQ(link_.say(Start{3}, now_), 2U);
  EXPECT_FALSE(link_.say(GiveControl{}, now_).has_value());
  const auto first = heard();
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->header.kind, Kind::kReplan);
  EXPECT_EQ(first->header.sequence, 1U);
  EXPECT_EQ(first->argument, 7U);
  const auto second = heard();
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->header.kind, Kind::kConsent);
  EXPECT_EQ(second->question, 3U);
  EXPECT_EQ(second->argument, 1U);
  answer(2, console::Verdict::kNotNow);
  const auto answers = link_.answers();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].of_sequence, 2U);
  EXPECT_TRUE(link_.answers().empty());
}

TEST_F(ControllerLinkTest, SaysWhenItIsSilentAndWhenItIsGone) {
  listen();
  connect();
  say_status(4);
  now_ += 999ms;
  link_.turn(now_);
  EXPECT_EQ(view().link, LinkState::kConnected);
  now_ += 1ms;
  link_.turn(now_);
  EXPECT_EQ(view().link, LinkState::kSilent);
  say_status(5);
  EXPECT_EQ(view().link, LinkState::kConnected);
  leave();
  EXPECT_EQ(view().link, LinkState::kAbsent);
  EXPECT_EQ(view().status->question, 5U);
}

TEST_F(ControllerLinkTest, KeepsDocumentsOfWhoIsGoneAndForgetsThemWithTheNext) {
  listen();
  connect();
  say_status();
  say_document(console::Document::kPlan, "{}");
  say_document(console::Document::kMission, "{\"name\":\"a\"}");
  const std::uint32_t revision = view().document(console::Document::kPlan).revision;
  EXPECT_GT(revision, 0U);
  say_document(console::Document::kPlan, "{}", 2);
  EXPECT_EQ(view().document(console::Document::kPlan).revision, revision);  // nothing new in it
  leave();
  EXPECT_TRUE(view().document(console::Document::kPlan).there());
  listen();
  connect();
  say_document(console::Document::kMission, "{\"name\":\"a\"}");
  EXPECT_TRUE(view().document(console::Document::kPlan).there());
  say_status();
  EXPECT_EQ(view().connections, 2U);
  EXPECT_FALSE(view().document(console::Document::kPlan).there());
  EXPECT_GT(view().document(console::Document::kPlan).revision, revision);
  EXPECT_TRUE(view().document(console::Document::kMission).there());
}

TEST_F(ControllerLinkTest, LeavesWhoSpeaksNonsense) {
  console::Status wrong;
  wrong.agents = 9;
  console::Status no_number;
  no_number.heading_rad = std::numeric_limits<double>::quiet_NaN();
  console::Status endless;
  endless.fault.fill('x');
  for (const console::Status& status : {wrong, no_number, endless}) {
    listen();
    connect();
    say(status, Kind::kStatus);
    EXPECT_EQ(view().link, LinkState::kNone);
    EXPECT_NE(link_.complaint().find("does not speak as this program does"), std::string::npos);
    leave();
  }
  listen();
  connect();
  (void)::send(controller_.get(), "hello", 5, MSG_NOSIGNAL);
  link_.turn(now_);
  EXPECT_NE(link_.complaint().find("does not speak"), std::string::npos);
  leave();
  listen();
  connect();
  say_document(static_cast<console::Document>(11), "");
  EXPECT_NE(link_.complaint().find("does not speak"), std::string::npos);
}

TEST_F(ControllerLinkTest, NeverWaitsForWhoDoesNotRead) {
  listen();
  connect();
  say_status();
  int said = 0;
  while (link_.say(Init{}, now_) && said < 1'000'000) {
    ++said;
  }
  EXPECT_LT(said, 1'000'000);
  EXPECT_EQ(view().link, LinkState::kConnected);
}

class RequestsTest : public ControllerLinkTest {
 protected:
  void SetUp() override {
    listen();
    connect();
    say_status();
  }
  Asker asker(Screen screen, bool fresh = false) const {
    return {.screen = screen, .owner = std::to_string(screen), .may_operate = screen < 10, .fresh = fresh};
  }
  std::string ask(Screen screen, const Request& request, bool fresh = false) {
    const auto verdict = requests_.ask(asker(screen, fresh), ++number_, request, now_);
    return verdict ? std::string(name_of(*verdict)) : "asked";
  }

  Controls controls_;
  Refusals refusals_;
  Requests requests_{link_, controls_, refusals_};
  std::uint32_t number_ = 0;
};

TEST_F(RequestsTest, AreTheOperatorsButForLookingStoppingAndSeeing) {
  EXPECT_EQ(ask(1, Init{}), "not_allowed");
  EXPECT_EQ(ask(1, Stop{}), "asked");
  EXPECT_EQ(ask(1, Found{}), "asked");
  EXPECT_EQ(ask(1, Position{}), "asked");
  EXPECT_EQ(ask(1, Beat{}), "accepted");
  EXPECT_EQ(ask(1, RequestControl{}), "accepted");
  EXPECT_EQ(ask(1, Init{}), "asked");
  EXPECT_EQ(ask(1, End{}), "asked");
  EXPECT_EQ(ask(2, End{}), "not_allowed");
  EXPECT_EQ(ask(10, RequestControl{}), "not_allowed");
  EXPECT_EQ(refusals_.of(Verdict::kNotAllowed), 3U);
}

TEST_F(RequestsTest, StartOverAFreshLinkAlone) {
  EXPECT_EQ(ask(1, RequestControl{}), "accepted");
  EXPECT_EQ(ask(1, Start{1}, false), "not_fresh");
  EXPECT_EQ(ask(1, Start{1}, true), "asked");
  EXPECT_EQ(ask(2, Start{1}, true), "not_allowed");
}

TEST_F(RequestsTest, PassOnTheOperatorsBeatsTenTimesASecondAtMost) {
  EXPECT_EQ(ask(1, RequestControl{}), "accepted");
  int passed_on = 0;
  for (int i = 0; i < 100; ++i) {
    passed_on += ask(1, Beat{}) == "asked" ? 1 : 0;
    EXPECT_EQ(ask(2, Beat{}), "accepted");
    now_ += 10ms;
  }
  EXPECT_GE(passed_on, 10);
  EXPECT_LE(passed_on, 20);
}

TEST_F(RequestsTest, AreSettledByTheControllersAnswer) {
  EXPECT_EQ(ask(3, Found{1}), "asked");
  answer(1, console::Verdict::kOutOfRange);
  const auto settled = requests_.settled(now_);
  ASSERT_EQ(settled.size(), 1U);
  EXPECT_EQ(settled[0].screen, 3U);
  EXPECT_EQ(settled[0].number, 1U);
  EXPECT_EQ(settled[0].verdict, Verdict::kOutOfRange);
  EXPECT_EQ(refusals_.by_controller(), 1U);
  answer(1, console::Verdict::kAccepted);  // once
  EXPECT_TRUE(requests_.settled(now_).empty());
}

TEST_F(RequestsTest, AreGivenUpWhenTheControllerIsGoneOrSaysNothing) {
  EXPECT_EQ(ask(1, Stop{}), "asked");
  EXPECT_TRUE(requests_.settled(now_).empty());
  now_ += Requests::kPatience;
  ASSERT_EQ(requests_.settled(now_).size(), 1U);
  EXPECT_EQ(ask(1, Stop{}), "asked");
  leave();
  const auto settled = requests_.settled(now_);
  ASSERT_EQ(settled.size(), 1U);
  EXPECT_EQ(settled[0].verdict, Verdict::kNoController);
  EXPECT_EQ(ask(1, Stop{}), "no_controller");
}

}  // namespace
}  // namespace ivo::firmware::web
