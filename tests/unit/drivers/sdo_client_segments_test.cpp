// Transfers in segments, both ways, and every way in which a node does them oddly or wrongly.
#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "config/rates.hpp"
#include "drivers/canopen/sdo_client.hpp"
#include "drivers/canopen/sdo_segment.hpp"

namespace ivo::drivers {
namespace {

using hal::CanFrame;

constexpr ObjectAddress kName{0x1008, 0};
constexpr std::uint16_t kRequest = 0x603;
constexpr std::uint16_t kAnswer = 0x583;

CanFrame initiated(std::uint8_t command, std::uint32_t data, ObjectAddress address = kName) {
  return sdo_frame(kAnswer, {command, address, data});
}

CanFrame segment(bool toggle, bool last, std::string_view data) {
  SdoSegment segment{.toggle = toggle, .last = last, .bytes = static_cast<std::uint8_t>(data.size()), .data = {}};
  std::copy(data.begin(), data.end(), segment.data.begin());
  return sdo_segment_frame(kAnswer, segment);
}

CanFrame upload_request(bool toggle) { return sdo_segment_frame(kRequest, sdo_command::kUploadSegment, toggle); }

CanFrame abort_of(SdoAbort code, ObjectAddress address = kName) {
  return sdo_frame(kRequest, {0x80, address, static_cast<std::uint32_t>(code)});
}

class SdoSegmentsTest : public testing::Test {
 protected:
  void begin_upload() {
    client_.forget();
    client_.start_upload(kName);
    ASSERT_EQ(client_.poll(now_), sdo_frame(kRequest, {0x40, kName, 0}));
  }
  void begin_number(std::uint8_t bytes) {
    client_.forget();
    client_.start_upload(kName, bytes);
    ASSERT_TRUE(client_.poll(now_).has_value());
  }
  /// The node answers `frame`; what the client says to that.
  std::optional<CanFrame> hear(const CanFrame& frame) {
    client_.on_frame(frame);
    return client_.poll(now_);
  }
  /// The client aborts with `code`, says so once, and nothing more.
  void expect_aborted(const CanFrame& frame, SdoAbort code) {
    EXPECT_EQ(hear(frame), abort_of(code));
    EXPECT_EQ(client_.status(), SdoStatus::kAborted);
    EXPECT_EQ(client_.abort_code(), code);
    EXPECT_FALSE(client_.poll(now_).has_value());
    now_ += 10 * rates::kSdoTimeout;
    EXPECT_FALSE(client_.poll(now_).has_value());
  }

  Instant now_{};
  SdoClient client_{3};
};

TEST(SdoSegment, IsCodedAsTheStandardSays) {
  EXPECT_EQ(segment(false, false, "abcdefg").data[0], 0x00);
  EXPECT_EQ(segment(true, true, "ab").data[0], 0x10 | 5 << 1 | 0x01);
  EXPECT_EQ(segment(false, true, "").data[0], 0x0F);
  EXPECT_EQ(upload_request(false).data[0], 0x60);
  EXPECT_EQ(upload_request(true).data[0], 0x70);
}

TEST(SdoSegment, GoesThereAndBackInEveryLength) {
  for (std::uint8_t bytes = 0; bytes <= 7; ++bytes) {
    for (const bool toggle : {false, true}) {
      for (const bool last : {false, true}) {
        const SdoSegment back =
            parse_sdo_segment(sdo_segment_frame(kAnswer, {.toggle = toggle, .last = last, .bytes = bytes, .data = {}}));
        EXPECT_EQ(back.toggle, toggle);
        EXPECT_EQ(back.last, last);
        EXPECT_EQ(back.bytes, bytes);
      }
    }
  }
}

TEST_F(SdoSegmentsTest, ReadsANameInSegmentsWithASize) {
  begin_upload();
  EXPECT_EQ(hear(initiated(0x41, 17)), upload_request(false));
  EXPECT_EQ(hear(segment(false, false, "IVO whe")), upload_request(true));
  EXPECT_EQ(hear(segment(true, false, "el driv")), upload_request(false));
  EXPECT_EQ(hear(segment(false, true, "e 1")), std::nullopt);
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(client_.text(), "IVO wheel drive 1");
  EXPECT_EQ(client_.bytes().size(), 17U);
}

TEST_F(SdoSegmentsTest, ReadsANameInSegmentsWithoutASize) {
  begin_upload();
  EXPECT_EQ(hear(initiated(0x40, 0)), upload_request(false));
  EXPECT_EQ(hear(segment(false, false, "abc")), upload_request(true)) << "a short one that is not the last";
  EXPECT_EQ(hear(segment(true, true, "defg")), std::nullopt);
  EXPECT_EQ(client_.text(), "abcdefg");
}

TEST_F(SdoSegmentsTest, ReadsANameOfNoLength) {
  begin_upload();
  EXPECT_EQ(hear(initiated(0x41, 0)), upload_request(false));
  EXPECT_EQ(hear(CanFrame{.id = kAnswer, .size = 8, .data = {0x0F}}), std::nullopt);
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(client_.text(), "");
  EXPECT_TRUE(client_.bytes().empty());
}

TEST_F(SdoSegmentsTest, ReadsAShortNameInOneFrame) {
  begin_upload();
  EXPECT_EQ(hear(initiated(0x47, 0x00434241)), std::nullopt);
  EXPECT_EQ(client_.text(), "ABC");
  begin_upload();
  hear(initiated(0x42, 0x00004241));
  EXPECT_EQ(client_.text(), "AB") << "no size, filled up with NUL";
  EXPECT_EQ(client_.bytes().size(), 4U);
}

TEST_F(SdoSegmentsTest, TakesNumbersOfEverySizeInSegments) {
  for (std::uint8_t bytes = 1; bytes <= 4; ++bytes) {
    for (const std::uint8_t command : {std::uint8_t{0x41}, std::uint8_t{0x40}}) {
      begin_number(bytes);
      ASSERT_EQ(hear(initiated(command, command == 0x41 ? bytes : 0)), upload_request(false));
      EXPECT_EQ(hear(segment(false, true, std::string_view("\x44\x33\x22\x11").substr(0, bytes))), std::nullopt);
      EXPECT_EQ(client_.status(), SdoStatus::kDone);
      EXPECT_EQ(client_.value(), low_bytes(0x11223344, bytes));
    }
  }
}

TEST_F(SdoSegmentsTest, TakesANumberWithOneByteASegment) {
  begin_number(4);
  hear(initiated(0x41, 4));
  EXPECT_EQ(hear(segment(false, false, "\x44")), upload_request(true));
  EXPECT_EQ(hear(segment(true, false, "\x33")), upload_request(false));
  EXPECT_EQ(hear(segment(false, false, "\x22")), upload_request(true));
  EXPECT_EQ(hear(segment(true, true, "\x11")), std::nullopt);
  EXPECT_EQ(client_.value(), 0x11223344U);
}

TEST_F(SdoSegmentsTest, TruncatesALongerAnswerToANumberAndRefusesAShorterOne) {
  begin_number(2);
  hear(initiated(0x41, 8));
  hear(segment(false, false, "\x44\x33\x22\x11wxy"));
  hear(segment(true, true, "z"));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(client_.value(), 0x3344U);
  begin_number(4);
  hear(initiated(0x41, 2));
  expect_aborted(segment(false, true, "\x44\x33"), SdoAbort::kLengthTooLow);
}

TEST_F(SdoSegmentsTest, ReadsAsMuchAsFitsAndAbortsWhatIsLonger) {
  begin_upload();
  EXPECT_EQ(hear(initiated(0x41, SdoClient::kMostBytes)), upload_request(false));
  begin_upload();
  expect_aborted(initiated(0x41, SdoClient::kMostBytes + 1), SdoAbort::kMemory);
  begin_upload();
  expect_aborted(initiated(0x41, 0xFFFFFFFF), SdoAbort::kMemory);
  begin_upload();
  hear(initiated(0x40, 0));
  bool toggle = false;
  for (std::size_t read = 0; read + 7 <= SdoClient::kMostBytes; read += 7) {
    ASSERT_EQ(hear(segment(toggle, false, "1234567")), upload_request(!toggle));
    toggle = !toggle;
  }
  expect_aborted(segment(toggle, false, "1234567"), SdoAbort::kMemory);
}

TEST_F(SdoSegmentsTest, RefusesMoreAndLessThanWasAnnounced) {
  begin_upload();
  hear(initiated(0x41, 3));
  expect_aborted(segment(false, true, "abcd"), SdoAbort::kLengthTooHigh);
  begin_upload();
  hear(initiated(0x41, 9));
  hear(segment(false, false, "abcdefg"));
  expect_aborted(segment(true, true, "h"), SdoAbort::kLengthTooLow);
  begin_upload();
  hear(initiated(0x41, 0));
  expect_aborted(segment(false, true, "a"), SdoAbort::kLengthTooHigh);
}

TEST_F(SdoSegmentsTest, RefusesEmptySegmentsThatNeverEnd) {
  begin_upload();
  hear(initiated(0x40, 0));
  expect_aborted(segment(false, false, ""), SdoAbort::kLengthTooLow);
}

TEST_F(SdoSegmentsTest, RefusesAToggleBitThatDoesNotAlternate) {
  begin_upload();
  hear(initiated(0x40, 0));
  expect_aborted(segment(true, false, "abcdefg"), SdoAbort::kToggle);
  begin_upload();
  hear(initiated(0x40, 0));
  hear(segment(false, false, "abcdefg"));
  expect_aborted(segment(false, false, "abcdefg"), SdoAbort::kToggle);
}

TEST_F(SdoSegmentsTest, RefusesAnUnknownServiceBetweenSegments) {
  for (const std::uint8_t command : std::initializer_list<std::uint8_t>{0x20, 0x60, 0xA0, 0xC0, 0xE0}) {
    begin_upload();
    hear(initiated(0x40, 0));
    expect_aborted(initiated(command, 0), SdoAbort::kCommandSpecifier);
  }
}

TEST_F(SdoSegmentsTest, DropsASecondAnswerToTheRequestThatInitiates) {
  begin_upload();
  hear(initiated(0x41, 2));
  EXPECT_EQ(hear(initiated(0x41, 2)), std::nullopt);
  EXPECT_TRUE(client_.awaiting_answer());
  hear(segment(false, true, "ab"));
  EXPECT_EQ(client_.text(), "ab");
}

TEST_F(SdoSegmentsTest, TakesTheAbortOfTheNodeAndSaysNothingMore) {
  begin_upload();
  hear(initiated(0x40, 0));
  EXPECT_EQ(hear(initiated(0x80, 0x08000000)), std::nullopt);
  EXPECT_EQ(client_.status(), SdoStatus::kAborted);
  EXPECT_EQ(client_.abort_code(), SdoAbort::kGeneral);
  now_ += 10 * rates::kSdoTimeout;
  EXPECT_FALSE(client_.poll(now_).has_value());
}

TEST_F(SdoSegmentsTest, DropsTheAbortOfAnotherTransfer) {
  begin_upload();
  hear(initiated(0x40, 0));
  EXPECT_EQ(hear(initiated(0x80, 0x08000000, {0x1009, 0})), std::nullopt);
  EXPECT_TRUE(client_.awaiting_answer());
}

TEST_F(SdoSegmentsTest, BeginsAnewWhenASegmentStaysAway) {
  begin_upload();
  hear(initiated(0x41, 9));
  hear(segment(false, false, "abcdefg"));
  now_ += rates::kSdoTimeout;
  EXPECT_EQ(client_.poll(now_), abort_of(SdoAbort::kTimeout));
  EXPECT_EQ(hear(segment(true, true, "hi")), sdo_frame(kRequest, {0x40, kName, 0})) << "it came too late";
  EXPECT_EQ(hear(segment(true, true, "hi")), std::nullopt) << "and once more";
  EXPECT_EQ(hear(initiated(0x41, 9)), upload_request(false));
  EXPECT_EQ(hear(segment(false, false, "ABCDEFG")), upload_request(true));
  hear(segment(true, true, "HI"));
  EXPECT_EQ(client_.text(), "ABCDEFGHI") << "nothing of the first attempt is left";
}

TEST_F(SdoSegmentsTest, GivesUpWhenASegmentStaysAwayInEveryAttempt) {
  client_.start_upload(kName);
  for (int attempt = 0; attempt < rates::kSdoAttempts; ++attempt) {
    EXPECT_EQ(client_.status(), SdoStatus::kBusy);
    ASSERT_EQ(client_.poll(now_), sdo_frame(kRequest, {0x40, kName, 0}));
    ASSERT_EQ(hear(initiated(0x40, 0)), upload_request(false));
    now_ += rates::kSdoTimeout;
    ASSERT_EQ(client_.poll(now_), abort_of(SdoAbort::kTimeout));
  }
  EXPECT_EQ(client_.status(), SdoStatus::kTimedOut);
  EXPECT_FALSE(client_.poll(now_).has_value());
}

TEST_F(SdoSegmentsTest, DropsSegmentsOfAWrongLength) {
  begin_upload();
  hear(initiated(0x40, 0));
  for (std::uint8_t size = 0; size < 8; ++size) {
    CanFrame frame = segment(false, true, "ab");
    frame.size = size;
    client_.on_frame(frame);
    EXPECT_TRUE(client_.awaiting_answer()) << int{size} << " bytes";
  }
}

std::vector<std::uint8_t> counted(std::size_t size) {
  std::vector<std::uint8_t> data(size);
  for (std::size_t i = 0; i < size; ++i) {
    data[i] = static_cast<std::uint8_t>(i + 1);
  }
  return data;
}

CanFrame confirmed(bool toggle) { return sdo_segment_frame(kAnswer, sdo_command::kDownloadedSegment, toggle); }

TEST_F(SdoSegmentsTest, WritesUpToFourBytesInOneFrame) {
  const std::array<std::uint8_t, 5> commands{0, 0x2F, 0x2B, 0x27, 0x23};
  for (std::size_t size = 1; size <= 4; ++size) {
    client_.forget();
    client_.start_download(kName, counted(size));
    EXPECT_EQ(client_.poll(now_),
              sdo_frame(kRequest, {commands[size], kName, low_bytes(0x04030201, static_cast<std::uint8_t>(size))}));
  }
}

TEST_F(SdoSegmentsTest, WritesLongerDataInSegmentsOfEveryLengthThereIs) {
  for (std::size_t size = 5; size <= SdoClient::kMostBytes; ++size) {
    const std::vector<std::uint8_t> data = counted(size);
    client_.forget();
    client_.start_download(kName, data);
    ASSERT_EQ(client_.poll(now_), sdo_frame(kRequest, {0x21, kName, static_cast<std::uint32_t>(size)}));
    std::optional<CanFrame> sent = hear(initiated(0x60, 0));
    std::vector<std::uint8_t> arrived;
    for (bool toggle = false; sent.has_value(); toggle = !toggle) {
      ASSERT_EQ(client_.status(), SdoStatus::kBusy);
      const SdoSegment part = parse_sdo_segment(*sent);
      EXPECT_EQ(part.toggle, toggle);
      arrived.insert(arrived.end(), part.data.begin(), part.data.begin() + part.bytes);
      EXPECT_EQ(part.last, arrived.size() == size);
      sent = hear(confirmed(toggle));
    }
    EXPECT_EQ(client_.status(), SdoStatus::kDone) << size;
    EXPECT_EQ(arrived, data);
  }
}

TEST_F(SdoSegmentsTest, WritesNothingAsOneEmptySegment) {
  client_.start_download(kName, std::span<const std::uint8_t>{});
  EXPECT_EQ(client_.poll(now_), sdo_frame(kRequest, {0x21, kName, 0}));
  EXPECT_EQ(hear(initiated(0x60, 0)), (CanFrame{.id = kRequest, .size = 8, .data = {0x0F}}));
  EXPECT_EQ(hear(confirmed(false)), std::nullopt);
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoSegmentsTest, RefusesAConfirmationWithTheWrongToggleBit) {
  client_.start_download(kName, counted(9));
  (void)client_.poll(now_);
  hear(initiated(0x60, 0));
  expect_aborted(confirmed(true), SdoAbort::kToggle);
}

TEST_F(SdoSegmentsTest, WritesAnewWhenAConfirmationStaysAway) {
  client_.start_download(kName, counted(9));
  (void)client_.poll(now_);
  hear(initiated(0x60, 0));
  ASSERT_TRUE(hear(confirmed(false)).has_value());
  now_ += rates::kSdoTimeout;
  EXPECT_EQ(client_.poll(now_), abort_of(SdoAbort::kTimeout));
  EXPECT_EQ(client_.poll(now_), sdo_frame(kRequest, {0x21, kName, 9}));
  const std::optional<CanFrame> first = hear(initiated(0x60, 0));
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(parse_sdo_segment(*first).data[0], 1) << "from the beginning";
  EXPECT_FALSE(parse_sdo_segment(*first).toggle);
}

TEST_F(SdoSegmentsTest, TrapsOnMoreDataThanItHasRoomFor) {
  EXPECT_DEATH(client_.start_download(kName, counted(SdoClient::kMostBytes + 1)), "");
}

// Whatever arrives: the client ends in a status, and never after an abort of the node with a frame of its own.
TEST_F(SdoSegmentsTest, SurvivesEveryCommandByteInEveryStage) {
  for (int stage = 0; stage < 4; ++stage) {
    for (int command = 0; command <= 0xFF; ++command) {
      client_.forget();
      if (stage < 2) {
        client_.start_upload(kName);
      } else {
        client_.start_download(kName, counted(9));
      }
      (void)client_.poll(now_);
      if (stage == 1) {
        hear(initiated(0x40, 0));
      } else if (stage == 3) {
        hear(initiated(0x60, 0));
      }
      hear(initiated(static_cast<std::uint8_t>(command), 0xFFFFFFFF));
      for (int i = 0; i < 20 && client_.status() == SdoStatus::kBusy; ++i) {
        now_ += rates::kSdoTimeout;
        (void)client_.poll(now_);
      }
      EXPECT_NE(client_.status(), SdoStatus::kBusy) << stage << ' ' << command;
      EXPECT_LE(client_.bytes().size(), SdoClient::kMostBytes);
    }
  }
}

}  // namespace
}  // namespace ivo::drivers
