#include "firmware/console/command_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

namespace ivo::firmware::console {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

Command ping(std::uint32_t sequence, Kind kind = Kind::kPing) {
  return {.header = {.kind = kind, .size = sizeof(Command), .sequence = sequence}};
}

class CommandCheckTest : public testing::Test {
 protected:
  Verdict judge(const Command& command) { return judge(std::as_bytes(std::span(&command, 1)), sizeof(command)); }
  Verdict judge(std::span<const std::byte> message, std::size_t size) {
    return check_.judge(message, size, now_, heard_);
  }

  const Command& heard() const { return std::get<Command>(heard_); }

  CommandCheck check_;
  RateLimit::Clock::time_point now_{1000s};
  ClientMessage heard_;
};

TEST_F(CommandCheckTest, TakesEveryKindOfCommandInOrder) {
  std::uint32_t sequence = 0;
  for (auto number = static_cast<int>(Kind::kPing); number < static_cast<int>(Kind::kPutArea); ++number) {
    const auto kind = static_cast<Kind>(number);
    Command command = ping(++sequence, kind);
    command.question = 40 + sequence;
    ASSERT_EQ(judge(command), Verdict::kAccepted);
    EXPECT_EQ(heard().header.kind, kind);
    EXPECT_EQ(heard().question, command.question);
  }
}

TEST_F(CommandCheckTest, RefusesEveryFieldThatIsWrongAndThenTakesTheMessageAsItShouldBe) {
  struct Row {
    Verdict verdict;
    std::function<void(Command&)> spoil;
  };
  const std::vector<Row> rows{
      {Verdict::kWrongMagic, [](Command& c) { c.header.magic ^= 1U; }},
      {Verdict::kWrongMagic, [](Command& c) { c.header.magic = 0x49564F43; }},  // of the other byte order
      {Verdict::kWrongVersion, [](Command& c) { c.header.version = 0; }},
      {Verdict::kWrongVersion, [](Command& c) { ++c.header.version; }},
      {Verdict::kUnknownKind, [](Command& c) { c.header.kind = Kind{}; }},
      {Verdict::kUnknownKind, [](Command& c) { c.header.kind = static_cast<Kind>(16); }},
      {Verdict::kUnknownKind, [](Command& c) { c.header.kind = Kind::kAnswer; }},
      {Verdict::kUnknownKind, [](Command& c) { c.header.kind = Kind::kStatus; }},
      {Verdict::kUnknownKind, [](Command& c) { c.header.kind = static_cast<Kind>(0xFFFF); }},
      {Verdict::kWrongSize, [](Command& c) { c.header.size = 0; }},
      {Verdict::kWrongSize, [](Command& c) { c.header.size = sizeof(Command) + 1; }},
      {Verdict::kWrongSize, [](Command& c) { c.header.size = std::numeric_limits<std::uint32_t>::max(); }},
      {Verdict::kWrongSize, [](Command& c) { c.header.kind = Kind::kPutArea; }},  // of another form
      {Verdict::kWrongSize, [](Command& c) { c.header.kind = Kind::kPose; }},
      {Verdict::kOutOfRange, [](Command& c) { c.argument = 2; }},  // watched is 1
      {Verdict::kReplayed, [](Command& c) { c.header.sequence = 0; }},
      {Verdict::kReplayed, [](Command& c) { c.header.sequence = 1; }},
      {Verdict::kOutOfOrder, [](Command& c) { c.header.sequence = 3; }},
      {Verdict::kOutOfOrder, [](Command& c) { c.header.sequence = std::numeric_limits<std::uint32_t>::max(); }},
  };
  ASSERT_EQ(judge(ping(1)), Verdict::kAccepted);
  heard_ = Command{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Command command = ping(2, Kind::kConsent);
    rows[i].spoil(command);
    EXPECT_EQ(judge(command), rows[i].verdict) << "row " << i;
    EXPECT_EQ(heard().header.sequence, 0U) << "row " << i;
  }
  EXPECT_EQ(judge(ping(2, Kind::kConsent)), Verdict::kAccepted);
}

TEST_F(CommandCheckTest, TakesAnArgumentOnlyWhereAKindHasOneAndInItsRange) {
  struct Row {
    Kind kind;
    std::uint32_t argument;
    Verdict verdict;
  };
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::vector<Row> rows{
      {Kind::kPing, 1, Verdict::kNotZero},
      {Kind::kNoConsent, 1, Verdict::kNotZero},
      {Kind::kStop, 1, Verdict::kNotZero},
      {Kind::kClearFault, kMost, Verdict::kNotZero},
      {Kind::kPause, 1, Verdict::kNotZero},
      {Kind::kInit, 1, Verdict::kNotZero},
      {Kind::kBeat, 1, Verdict::kNotZero},
      {Kind::kConsent, 1, Verdict::kAccepted},
      {Kind::kConsent, 2, Verdict::kOutOfRange},
      {Kind::kConsent, kMost, Verdict::kOutOfRange},
      {Kind::kReplan, kMost, Verdict::kAccepted},
      {Kind::kEnough, kMost, Verdict::kAccepted},
      {Kind::kAccept, kMost, Verdict::kAccepted},
      {Kind::kFound, kAgents - 1, Verdict::kAccepted},
      {Kind::kFound, kAgents, Verdict::kOutOfRange},
      {Kind::kRemoveArea, kAreaSlots - 1, Verdict::kAccepted},
      {Kind::kRemoveArea, kAreaSlots, Verdict::kOutOfRange},
      {Kind::kRemoveArea, kMost, Verdict::kOutOfRange},
  };
  std::uint32_t sequence = 0;
  for (const Row& row : rows) {
    Command command = ping(sequence + 1, row.kind);
    command.argument = row.argument;
    EXPECT_EQ(judge(command), row.verdict) << static_cast<int>(row.kind) << " with " << row.argument;
    sequence += row.verdict == Verdict::kAccepted ? 1 : 0;
  }
}

TEST_F(CommandCheckTest, RefusesEverySizeButItsOwn) {
  std::array<std::byte, 2 * sizeof(Command)> packet{};
  const Command command = ping(1);
  std::memcpy(packet.data(), &command, sizeof(command));
  for (std::size_t size = 0; size < packet.size(); ++size) {
    if (size != sizeof(Command)) {
      EXPECT_EQ(judge(std::span(packet).first(size), size), Verdict::kWrongSize) << size;
    }
  }
  EXPECT_EQ(judge(std::span(packet).first(sizeof(Command)), sizeof(Command) + 1), Verdict::kWrongSize) << "cut";
  EXPECT_EQ(judge(command), Verdict::kAccepted);
}

TEST_F(CommandCheckTest, ClaimsNoSequenceOfWhatIsTooShortForOne) {
  const Command command = ping(77);
  const auto bytes = std::as_bytes(std::span(&command, 1));
  EXPECT_EQ(claimed_sequence(bytes), 77U);
  EXPECT_EQ(claimed_sequence(bytes.first(sizeof(Header))), 77U);
  EXPECT_EQ(claimed_sequence(bytes.first(sizeof(Header) - 1)), 0U);
  EXPECT_EQ(claimed_sequence({}), 0U);
}

TEST_F(CommandCheckTest, RefusesWhatComesTooOftenButGoesOnCounting) {
  std::uint32_t sequence = 0;
  for (int i = 0; i < kCommandsPerSecond; ++i) {
    ASSERT_EQ(judge(ping(++sequence)), Verdict::kAccepted) << i;
  }
  EXPECT_EQ(judge(ping(++sequence, Kind::kConsent)), Verdict::kTooOften);
  EXPECT_EQ(judge(ping(sequence)), Verdict::kReplayed);
  now_ += 1000ms / kCommandsPerSecond;
  EXPECT_EQ(judge(ping(++sequence)), Verdict::kAccepted);
  EXPECT_EQ(judge(ping(++sequence)), Verdict::kTooOften);
  now_ += 3600s;
  for (int i = 0; i < kCommandsPerSecond; ++i) {
    ASSERT_EQ(judge(ping(++sequence)), Verdict::kAccepted) << i;
  }
  EXPECT_EQ(judge(ping(++sequence)), Verdict::kTooOften) << "silence is not saved up";
}

TEST_F(CommandCheckTest, NeverRefusesAStopOrAPauseForItsRate) {
  for (std::uint32_t sequence = 1; sequence <= 1000; ++sequence) {
    const Kind kind = sequence % 2 == 0 ? Kind::kStop : Kind::kPause;
    ASSERT_EQ(judge(ping(sequence, kind)), Verdict::kAccepted) << sequence;
  }
}

}  // namespace
}  // namespace ivo::firmware::console
