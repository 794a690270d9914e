#include "drivers/canopen/emcy_history.hpp"

#include <gtest/gtest.h>

#include "drivers/canopen/emcy_text.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Instant after(Duration d) { return Instant(d); }

TEST(EmcyHistory, KeepsWhatEachEmergencySaid) {
  EmcyHistory history;
  EXPECT_TRUE(history.add({0x8130, 0x11, {1, 2, 3, 4, 5}}, after(milliseconds(7))));
  ASSERT_EQ(history.entries().size(), 1U);
  const EmcyEntry& entry = history.entries()[0];
  EXPECT_EQ(entry.emergency, (Emergency{0x8130, 0x11, {1, 2, 3, 4, 5}}));
  EXPECT_EQ(entry.first, after(milliseconds(7)));
  EXPECT_EQ(entry.count, 1U);
}

TEST(EmcyHistory, CountsRepeatsTogetherThoughOthersComeInBetween) {
  EmcyHistory history;
  for (int i = 0; i < 1000; ++i) {
    const bool fresh = history.add({0x2310, 2, {}}, after(milliseconds(2 * i)));
    EXPECT_EQ(fresh, i == 0);
    EXPECT_EQ(history.add({0x4310, 8, {}}, after(milliseconds(2 * i + 1))), i == 0);
  }
  ASSERT_EQ(history.entries().size(), 2U);
  EXPECT_EQ(history.entries()[0].count, 1000U);
  EXPECT_EQ(history.entries()[0].first, after(milliseconds(0)));
  EXPECT_EQ(history.entries()[0].last, after(milliseconds(1998)));
  EXPECT_EQ(history.total(), 2000U);
  EXPECT_EQ(history.forgotten(), 0U);
}

TEST(EmcyHistory, TellsTheSameCodeAnewAfterASecondOfPeace) {
  EmcyHistory history;
  EXPECT_TRUE(history.add({0x2310, 2, {}}, after(seconds(1))));
  EXPECT_FALSE(history.add({0x2310, 2, {}}, after(seconds(2))));
  EXPECT_TRUE(history.add({0x2310, 2, {}}, after(seconds(3) + Duration(1))));
  EXPECT_EQ(history.entries().size(), 2U);
}

TEST(EmcyHistory, TellsNoMoreThanEightNewOnesASecondInAStorm) {
  EmcyHistory history;
  int told = 0;
  for (int i = 0; i < 10'000; ++i) {  // ten seconds of ever other codes
    told += history.add({static_cast<std::uint16_t>(i + 1), 1, {}}, after(milliseconds(i))) ? 1 : 0;
  }
  EXPECT_LE(told, 10 * static_cast<int>(EmcyHistory::kNewEntries));
  EXPECT_GE(told, 9 * static_cast<int>(EmcyHistory::kNewEntries));
  EXPECT_EQ(history.entries().size(), EmcyHistory::kEntries);
  EXPECT_EQ(history.total(), 10'000U);
  EXPECT_EQ(history.forgotten() + EmcyHistory::kEntries, 10'000U);
}

TEST(EmcyHistory, PushesTheOldestOut) {
  EmcyHistory history;
  for (std::uint16_t i = 1; i <= EmcyHistory::kEntries + 3; ++i) {
    history.add({i, 1, {}}, after(seconds(2 * i)));
  }
  EXPECT_EQ(history.entries()[0].emergency.code, 4);
  EXPECT_EQ(history.entries().back().emergency.code, EmcyHistory::kEntries + 3);
  EXPECT_EQ(history.forgotten(), 3U);
}

TEST(EmcyText, NamesTheMostExactClass) {
  EXPECT_EQ(emergency_class(0x0000), "errors gone");
  EXPECT_EQ(emergency_class(0x8130), "heartbeat or node guarding lost");
  EXPECT_EQ(emergency_class(0x8250), "RPDO timed out");
  EXPECT_EQ(emergency_class(0x8199), "communication");
  EXPECT_EQ(emergency_class(0x2310), "continuous over-current, output side");
  EXPECT_EQ(emergency_class(0x2344), "current, output side");
  EXPECT_EQ(emergency_class(0x2999), "current");
  EXPECT_EQ(emergency_class(0x3220), "DC link under-voltage");
  EXPECT_EQ(emergency_class(0x3230), "voltage inside the device, DC link");
  EXPECT_EQ(emergency_class(0x42FF), "temperature");
  EXPECT_EQ(emergency_class(0x7305), "sensor");
  EXPECT_EQ(emergency_class(0x8611), "following error");
  EXPECT_EQ(emergency_class(0xFF01), "device specific");
  EXPECT_EQ(emergency_class(0xB000), "unknown error");
}

TEST(EmcyText, SaysAnEntryInOneLine) {
  EmcyEntry entry{.emergency = {0x8130, 0x11, {1, 0xAB, 0, 0, 0}}, .count = 3};
  EXPECT_EQ(
      describe(entry),
      "emergency 8130h, heartbeat or node guarding lost (error register 11h: generic, communication; vendor 01 AB "
      "00 00 00), 3 times");
  entry = {.emergency = {0x0000, 0, {}}, .count = 1};
  EXPECT_EQ(describe(entry), "emergency 0000h, errors gone (error register 00h; vendor 00 00 00 00 00)");
}

TEST(Emergency, CarriesFiveBytesOfTheVendor) {
  const hal::CanFrame frame = emergency_frame(2, {0xFF01, 0x81, {9, 8, 7, 6, 5}});
  EXPECT_EQ(frame, (hal::CanFrame{.id = 0x82, .size = 8, .data = {0x01, 0xFF, 0x81, 9, 8, 7, 6, 5}}));
  EXPECT_EQ(parse_emergency(frame), (Emergency{0xFF01, 0x81, {9, 8, 7, 6, 5}}));
}

}  // namespace
}  // namespace ivo::drivers
