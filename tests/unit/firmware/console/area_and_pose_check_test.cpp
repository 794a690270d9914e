// Areas and poses at the console's door, field by field.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "firmware/console/command_check.hpp"

namespace ivo::firmware::console {
namespace {

using std::chrono_literals::operator""s;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

AreaCommand triangle() {
  AreaCommand area;
  area.header = {.kind = Kind::kPutArea, .size = sizeof(AreaCommand), .sequence = 1};
  area.slot = 3;
  area.agent = 1;
  area.corners = 3;
  area.corner[0] = {1, 1};
  area.corner[1] = {4, 1};
  area.corner[2] = {1, 5};
  return area;
}

PoseCommand seen() {
  PoseCommand pose;
  pose.header = {.kind = Kind::kPose, .size = sizeof(PoseCommand), .sequence = 1};
  pose.agent = 1;
  pose.x_m = 3;
  pose.y_m = 4;
  pose.heading_rad = -1;
  pose.sigma_m = 0.5;
  pose.sigma_heading_rad = 0.1;
  pose.age_s = 0.2;
  return pose;
}

template <class Message>
struct Spoilt {
  Verdict verdict;
  std::function<void(Message&)> spoil;
};

template <class Message>
class OneForm : public testing::Test {
 protected:
  Verdict judge(const Message& message) {
    return check_.judge(std::as_bytes(std::span(&message, 1)), sizeof(message), now_, heard_);
  }
  /// Each is refused by its name and leaves no trace; the message as it should be is taken then.
  void expect_refused(const Message& good, const std::vector<Spoilt<Message>>& rows) {
    heard_ = Command{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Message message = good;
      rows[i].spoil(message);
      EXPECT_EQ(judge(message), rows[i].verdict) << "row " << i;
      EXPECT_FALSE(std::holds_alternative<Message>(heard_)) << "row " << i;
    }
    EXPECT_EQ(judge(good), Verdict::kAccepted);
    ASSERT_TRUE(std::holds_alternative<Message>(heard_));
    EXPECT_EQ(std::memcmp(&std::get<Message>(heard_), &good, sizeof(good)), 0);
  }
  void expect_no_other_size(const Message& good) {
    std::array<std::byte, sizeof(AreaCommand) + 200> packet{};
    std::memcpy(packet.data(), &good, sizeof(good));
    for (std::size_t size = 0; size < packet.size(); ++size) {
      if (size != sizeof(good)) {
        ASSERT_EQ(check_.judge(std::span(packet).first(size), size, now_, heard_), Verdict::kWrongSize) << size;
      }
    }
    EXPECT_EQ(check_.judge(std::span(packet).first(sizeof(good)), sizeof(good) + 1, now_, heard_), Verdict::kWrongSize)
        << "cut";
    EXPECT_EQ(judge(good), Verdict::kAccepted);
  }

  CommandCheck check_;
  RateLimit::Clock::time_point now_{1000s};
  ClientMessage heard_;
};

using AreaCheckTest = OneForm<AreaCommand>;
using PoseCheckTest = OneForm<PoseCommand>;

TEST_F(AreaCheckTest, RefusesEveryFieldThatIsWrong) {
  expect_refused(triangle(),
                 {
                     {Verdict::kWrongMagic, [](AreaCommand& a) { a.header.magic ^= 1U; }},
                     {Verdict::kWrongVersion, [](AreaCommand& a) { --a.header.version; }},
                     {Verdict::kWrongSize, [](AreaCommand& a) { a.header.size = sizeof(Command); }},
                     {Verdict::kWrongSize, [](AreaCommand& a) { a.header.kind = Kind::kPose; }},
                     {Verdict::kWrongSize, [](AreaCommand& a) { a.header.kind = Kind::kStop; }},
                     {Verdict::kUnknownKind, [](AreaCommand& a) { a.header.kind = static_cast<Kind>(16); }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.slot = kAreaSlots; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.slot = 255; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.purpose = static_cast<AreaPurpose>(2); }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.agent = kAgents; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.agent = AreaCommand::kEverybody; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.corners = kAreaCorners + 1; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.corners = 255; }},
                     {Verdict::kNotAnArea, [](AreaCommand& a) { a.corners = 2; }},
                     {Verdict::kNotAnArea, [](AreaCommand& a) { a.corners = 0; }},
                     {Verdict::kNotZero, [](AreaCommand& a) { a.zero = 1; }},
                     {Verdict::kNotZero, [](AreaCommand& a) { a.corner[3].x_m = 1e-300; }},
                     {Verdict::kNotZero, [](AreaCommand& a) { a.corner[3].y_m = kNotANumber; }},
                     {Verdict::kNotZero, [](AreaCommand& a) { a.corner[kAreaCorners - 1].y_m = -1; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.corner[0].x_m = kNotANumber; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.corner[2].y_m = kNotANumber; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.corner[1].x_m = kInfinite; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.corner[1].y_m = -kInfinite; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.corner[1].y_m = 1e300; }},
                     {Verdict::kOutOfRange, [](AreaCommand& a) { a.corner[1].y_m = -1.0001e6; }},
                     {Verdict::kReplayed, [](AreaCommand& a) { a.header.sequence = 0; }},
                     {Verdict::kOutOfOrder, [](AreaCommand& a) { a.header.sequence = 2; }},
                 });
}

TEST_F(AreaCheckTest, TakesAsManyCornersAsThereIsRoomFor) {
  AreaCommand area = triangle();
  area.corners = kAreaCorners;
  for (std::size_t i = 0; i < area.corner.size(); ++i) {
    area.corner[i] = {static_cast<double>(i), static_cast<double>(i * i)};
  }
  expect_refused(area, {{Verdict::kOutOfRange, [](AreaCommand& a) { a.corner[kAreaCorners - 1].x_m = kNotANumber; }}});
}

TEST_F(AreaCheckTest, OfEverybodyOnlyANoGoIsTaken) {
  AreaCommand area = triangle();
  area.agent = AreaCommand::kEverybody;
  area.purpose = AreaPurpose::kNoGo;
  expect_refused(area, {{Verdict::kOutOfRange, [](AreaCommand& a) { a.purpose = AreaPurpose::kPreferred; }},
                        {Verdict::kOutOfRange, [](AreaCommand& a) { a.agent = 254; }}});
}

TEST_F(AreaCheckTest, RefusesEverySizeButItsOwn) { expect_no_other_size(triangle()); }

TEST_F(AreaCheckTest, CountsWithTheRateOfAllMessages) {
  AreaCommand area = triangle();
  for (; area.header.sequence <= static_cast<std::uint32_t>(kCommandsPerSecond); ++area.header.sequence) {
    ASSERT_EQ(judge(area), Verdict::kAccepted);
  }
  EXPECT_EQ(judge(area), Verdict::kTooOften);
}

TEST_F(PoseCheckTest, RefusesEveryFieldThatIsWrong) {
  std::vector<Spoilt<PoseCommand>> rows{
      {Verdict::kWrongMagic, [](PoseCommand& p) { p.header.magic = 0; }},
      {Verdict::kWrongVersion, [](PoseCommand& p) { ++p.header.version; }},
      {Verdict::kWrongSize, [](PoseCommand& p) { p.header.size = sizeof(AreaCommand); }},
      {Verdict::kWrongSize, [](PoseCommand& p) { p.header.kind = Kind::kPutArea; }},
      {Verdict::kOutOfRange, [](PoseCommand& p) { p.agent = kAgents; }},
      {Verdict::kOutOfRange, [](PoseCommand& p) { p.agent = 255; }},
      {Verdict::kOutOfRange, [](PoseCommand& p) { p.x_m = 2e6; }},
      {Verdict::kOutOfRange, [](PoseCommand& p) { p.heading_rad = 1e9; }},
      {Verdict::kOutOfRange, [](PoseCommand& p) { p.sigma_m = -0.001; }},
      {Verdict::kOutOfRange, [](PoseCommand& p) { p.sigma_heading_rad = -1e-9; }},
      {Verdict::kOutOfRange, [](PoseCommand& p) { p.age_s = -0.001; }},
      {Verdict::kOutOfRange, [](PoseCommand& p) { p.age_s = 10.001; }},
      {Verdict::kReplayed, [](PoseCommand& p) { p.header.sequence = 0; }},
      {Verdict::kOutOfOrder, [](PoseCommand& p) { p.header.sequence = 7; }},
  };
  for (std::size_t i = 0; i < PoseCommand{}.zero.size(); ++i) {
    rows.push_back({Verdict::kNotZero, [i](PoseCommand& p) { p.zero[i] = 0x80; }});
  }
  for (double PoseCommand::*const field :
       {&PoseCommand::x_m, &PoseCommand::y_m, &PoseCommand::heading_rad, &PoseCommand::sigma_m,
        &PoseCommand::sigma_heading_rad, &PoseCommand::age_s}) {
    for (const double number : {kNotANumber, -kNotANumber, kInfinite, -kInfinite}) {
      rows.push_back({Verdict::kOutOfRange, [field, number](PoseCommand& p) { p.*field = number; }});
    }
  }
  expect_refused(seen(), rows);
}

TEST_F(PoseCheckTest, TakesWhatIsJustInRange) {
  PoseCommand pose = seen();
  pose.agent = kAgents - 1;
  pose.x_m = 1e6;
  pose.y_m = -1e6;
  pose.sigma_m = 0;
  pose.sigma_heading_rad = 0;
  pose.age_s = 10;
  EXPECT_EQ(judge(pose), Verdict::kAccepted) << "whether a mission has that place is for others to say";
}

TEST_F(PoseCheckTest, RefusesEverySizeButItsOwn) { expect_no_other_size(seen()); }

}  // namespace
}  // namespace ivo::firmware::console
