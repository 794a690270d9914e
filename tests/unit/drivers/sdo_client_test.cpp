#include "drivers/canopen/sdo_client.hpp"

#include <gtest/gtest.h>

#include "config/rates.hpp"

namespace ivo::drivers {
namespace {

constexpr ObjectAddress kObject{0x6061, 0};

hal::CanFrame answer(std::uint8_t command, std::uint32_t data, ObjectAddress address = kObject) {
  return sdo_frame(0x583, {command, address, data});
}

/// A client of node 3 whose request has just gone out.
class SdoClientUnderTest : public testing::Test {
 protected:
  void upload(std::uint8_t bytes) {
    client_.forget();
    client_.start_upload(kObject, bytes);
    ASSERT_TRUE(client_.poll(now_).has_value());
  }
  void download(std::uint8_t bytes, std::uint32_t value) {
    client_.forget();
    client_.start_download(kObject, bytes, value);
    ASSERT_TRUE(client_.poll(now_).has_value());
  }

  Instant now_{};
  SdoClient client_{3};
};

using SdoClientTest = SdoClientUnderTest;

TEST_F(SdoClientTest, AsksForAnObjectOnce) {
  client_.start_upload(kObject, 1);
  EXPECT_FALSE(client_.awaiting_answer());
  const auto request = client_.poll(now_);
  EXPECT_EQ(request, (hal::CanFrame{.id = 0x603, .size = 8, .data = {0x40, 0x61, 0x60, 0}}));
  EXPECT_TRUE(client_.awaiting_answer());
  EXPECT_FALSE(client_.poll(now_).has_value());
}

TEST_F(SdoClientTest, WritesWithTheCommandOfTheSize) {
  const std::array<std::uint8_t, 5> commands{0, 0x2F, 0x2B, 0x27, 0x23};
  for (std::uint8_t bytes = 1; bytes <= 4; ++bytes) {
    client_.forget();
    client_.start_download({0x60FF, 2}, bytes, 0xFFFFFFFF);
    const auto request = client_.poll(now_);
    ASSERT_TRUE(request.has_value());
    EXPECT_EQ(request->data[0], commands[bytes]);
    EXPECT_EQ(request->data[1], 0xFF);
    EXPECT_EQ(request->data[2], 0x60);
    EXPECT_EQ(request->data[3], 2);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(request->data[4 + i], i < bytes ? 0xFF : 0) << "unused bytes are zero";
    }
  }
}

TEST_F(SdoClientTest, TakesEveryExpeditedAnswerThatHoldsTheObject) {
  struct Case {
    std::uint8_t command;
    std::uint8_t bytes;
    std::uint32_t value;
  };
  for (const Case& c : {Case{0x4F, 1, 0x44}, Case{0x4B, 2, 0x3344}, Case{0x47, 2, 0x3344}, Case{0x43, 4, 0x11223344},
                        Case{0x42, 1, 0x44}, Case{0x42, 2, 0x3344}, Case{0x42, 4, 0x11223344}, Case{0x43, 1, 0x44}}) {
    upload(c.bytes);
    client_.on_frame(answer(c.command, 0x11223344));
    EXPECT_EQ(client_.status(), SdoStatus::kDone);
    EXPECT_EQ(client_.value(), c.value);
  }
}

TEST_F(SdoClientTest, RefusesAnAnswerShorterThanTheObjectAndSaysSo) {
  upload(4);
  client_.on_frame(answer(0x4B, 0x1234));
  EXPECT_EQ(client_.status(), SdoStatus::kAborted);
  EXPECT_EQ(client_.abort_code(), SdoAbort::kLengthTooLow);
  EXPECT_EQ(client_.poll(now_), sdo_frame(0x603, {0x80, kObject, 0x06070013}));
  EXPECT_FALSE(client_.poll(now_).has_value());
}

TEST_F(SdoClientTest, AbortsWhatIsUnderWayBeforeItBeginsAnew) {
  upload(4);
  client_.start_download({0x6060, 0}, 1, 9);
  EXPECT_FALSE(client_.awaiting_answer());
  EXPECT_EQ(client_.poll(now_), sdo_frame(0x603, {0x80, kObject, 0x08000000}));
  EXPECT_EQ(client_.poll(now_), sdo_frame(0x603, {0x2F, {0x6060, 0}, 9}));
  client_.on_frame(answer(0x43, 7));
  EXPECT_TRUE(client_.awaiting_answer()) << "late, of the aborted one";
  client_.on_frame(answer(0x60, 0, {0x6060, 0}));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoClientTest, SendsItsAbortThoughTheNextTransferHasBegun) {
  upload(4);
  client_.on_frame(answer(0x4B, 0x1234));
  ASSERT_EQ(client_.status(), SdoStatus::kAborted);
  client_.start_upload(kObject, 2);
  EXPECT_EQ(client_.poll(now_), sdo_frame(0x603, {0x80, kObject, 0x06070013}));
  EXPECT_EQ(client_.poll(now_), sdo_frame(0x603, {0x40, kObject, 0}));
}

TEST_F(SdoClientTest, SaysNothingToANodeThatWasReset) {
  upload(4);
  client_.forget();
  EXPECT_EQ(client_.status(), SdoStatus::kIdle);
  EXPECT_FALSE(client_.poll(now_).has_value());
  client_.start_upload(kObject, 2);
  EXPECT_EQ(client_.poll(now_)->data[0], 0x40);
}

TEST_F(SdoClientTest, DropsAnswersOfAnotherNode) {
  upload(1);
  client_.on_frame(sdo_frame(0x582, {0x4F, kObject, 9}));
  client_.on_frame(sdo_frame(0x603, {0x4F, kObject, 9}));
  EXPECT_TRUE(client_.awaiting_answer());
}

TEST_F(SdoClientTest, TakesTheConfirmationOfAWrite) {
  download(1, 9);
  client_.on_frame(answer(0x60, 0));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoClientTest, TellsTheAbortCodeOfTheNode) {
  download(1, 9);
  client_.on_frame(answer(0x80, 0x06090030));
  EXPECT_EQ(client_.status(), SdoStatus::kAborted);
  EXPECT_EQ(client_.abort_code(), SdoAbort::kValueRange);
  EXPECT_FALSE(client_.poll(now_).has_value()) << "an abort is not answered";
}

TEST_F(SdoClientTest, DropsAnswersToAnotherObjectOrService) {
  upload(1);
  client_.on_frame(answer(0x4F, 9, {0x6061, 1}));
  client_.on_frame(answer(0x4F, 9, {0x6060, 0}));
  client_.on_frame(answer(0x80, 0x06090030, {0x6060, 0}));
  client_.on_frame(answer(0x60, 0));
  client_.on_frame(answer(0x00, 0));
  client_.on_frame(answer(0xFF, 0));
  EXPECT_TRUE(client_.awaiting_answer());
  download(1, 9);
  client_.on_frame(answer(0x4F, 9));
  EXPECT_TRUE(client_.awaiting_answer());
}

TEST_F(SdoClientTest, DropsAnswersOfEveryWrongLength) {
  upload(1);
  for (std::uint8_t size = 0; size < 8; ++size) {
    hal::CanFrame frame = answer(0x4F, 9);
    frame.size = size;
    client_.on_frame(frame);
    EXPECT_TRUE(client_.awaiting_answer()) << int{size} << " bytes";
  }
}

TEST_F(SdoClientTest, DropsAnswersThatNobodyAskedFor) {
  client_.on_frame(answer(0x4F, 9));
  EXPECT_EQ(client_.status(), SdoStatus::kIdle);
  client_.start_upload(kObject, 1);
  client_.on_frame(answer(0x4F, 9));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy) << "the request has not gone out yet";
}

TEST_F(SdoClientTest, AfterEachTimeOutAbortsThenAsksAgainAndAtLastGivesUp) {
  client_.start_upload(kObject, 1);
  const hal::CanFrame abort = sdo_frame(0x603, {0x80, kObject, 0x05040000});
  for (int attempt = 1; attempt <= rates::kSdoAttempts; ++attempt) {
    EXPECT_EQ(client_.poll(now_)->data[0], 0x40);
    now_ += rates::kSdoTimeout - Duration(1);
    EXPECT_FALSE(client_.poll(now_).has_value()) << "attempt " << attempt;
    now_ += Duration(1);
    EXPECT_EQ(client_.poll(now_), abort);
  }
  EXPECT_EQ(client_.status(), SdoStatus::kTimedOut);
  EXPECT_EQ(client_.abort_code(), SdoAbort::kTimeout);
  EXPECT_FALSE(client_.poll(now_).has_value());
  client_.on_frame(answer(0x4F, 9));
  EXPECT_EQ(client_.status(), SdoStatus::kTimedOut) << "a late answer is dropped";
}

TEST_F(SdoClientTest, AcceptsTheAnswerToASecondAttempt) {
  upload(1);
  now_ += rates::kSdoTimeout;
  ASSERT_TRUE(client_.poll(now_).has_value());
  client_.on_frame(answer(0x4F, 8));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy) << "it answers the transfer that we have aborted";
  ASSERT_TRUE(client_.poll(now_).has_value());
  client_.on_frame(answer(0x4F, 9));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(client_.value(), 9U);
}

TEST(SdoAbortNames, AreTheStandardsAndUnknownOnesAreSaidToBe) {
  EXPECT_EQ(name_of(SdoAbort::kValueRange), "value range exceeded");
  EXPECT_EQ(name_of(SdoAbort{0x06020000}), "object does not exist");
  EXPECT_EQ(name_of(SdoAbort{0x12345678}), "unknown abort code");
}

}  // namespace
}  // namespace ivo::drivers
