#include "firmware/record/mcap_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "firmware/record/base64.hpp"
#include "firmware/record/crc32.hpp"
#include "tests/support/mcap.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_disk.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ns;
using std::chrono_literals::operator""s;

constexpr std::uint8_t kSchema = 3;
constexpr std::uint8_t kChannel = 4;
constexpr std::uint8_t kMessage = 5;
constexpr std::uint8_t kChunk = 6;
constexpr std::uint8_t kMessageIndex = 7;
constexpr std::uint8_t kChunkIndex = 8;
constexpr std::size_t kBeforeCrc = 3 * 8;  // bytes of a chunk: its times, its size

class McapFileTest : public testing::Test {
 protected:
  std::string path() const { return folder_.path("run.mcap"); }
  McapFile create() const {
    Result<McapFile> file = McapFile::create(path());
    EXPECT_TRUE(file.ok());
    return std::move(file).value();
  }
  std::string bytes() const {
    std::ostringstream text;
    text << std::ifstream(path(), std::ios::binary).rdbuf();
    return text.str();
  }
  static std::vector<int> ops(const std::vector<McapRecord>& records) {
    std::vector<int> ops;
    ops.reserve(records.size());
    for (const McapRecord& record : records) {
      ops.push_back(record.op);
    }
    return ops;
  }

  /// The messages of a chunk, and whether all it says of them is true.
  static std::vector<McapRecord> unpacked(const McapRecord& chunk) {
    McapBytes bytes(chunk.content);
    (void)bytes.take(2 * 8);
    const std::uint64_t size = bytes.number(8);
    const std::uint64_t crc = bytes.number(4);
    EXPECT_EQ(bytes.text(), "") << "not compressed";
    EXPECT_EQ(bytes.number(8), size);
    const std::string messages = bytes.rest();
    EXPECT_EQ(messages.size(), size);
    EXPECT_EQ(crc32(messages), crc);
    return mcap_records(std::string(kMcapMagic) + messages, false);
  }

  ScratchFolder folder_;
};

TEST_F(McapFileTest, HoldsSchemasChannelsAndChunksThatAreDoneThoughNobodyClosesIt) {
  McapFile file = create();
  const auto pose = file.add_channel("/robot/pose", {"Pose", R"({"type":"object"})"});
  const auto other = file.add_channel("/person/pose", {"Pose", R"({"type":"object"})"});
  file.add_message(pose, 7ns, R"({"x":1})");
  file.add_message(other, 9ns, R"({"x":2})");
  file.add_message(pose, 1s + 7ns, R"({"x":3})");
  file.add_message(pose, 1s + 8ns, "{}");  // of a chunk under way
  file.write_out();
  const auto records = mcap_records(bytes(), false);
  ASSERT_EQ(ops(records), (std::vector<int>{1, kSchema, kChannel, kChannel, kChunk, kMessageIndex, kMessageIndex}));
  EXPECT_EQ(file.messages(), 3U);
  const auto messages = unpacked(records[4]);
  ASSERT_EQ(ops(messages), (std::vector<int>{kMessage, kMessage, kMessage}));
  McapBytes schema(records[1].content);
  EXPECT_EQ(schema.number(2), 1U) << "0 is no schema";
  EXPECT_EQ(schema.text(), "Pose");
  EXPECT_EQ(schema.text(), "jsonschema");
  EXPECT_EQ(schema.text(), R"({"type":"object"})");
  McapBytes channel(records[3].content);
  EXPECT_EQ(channel.number(2), other);
  EXPECT_EQ(channel.number(2), 1U);
  EXPECT_EQ(channel.text(), "/person/pose");
  EXPECT_EQ(channel.text(), "json");
  EXPECT_EQ(channel.number(4), 0U) << "no metadata";
  McapBytes last(messages[2].content);
  EXPECT_EQ(last.number(2), pose);
  EXPECT_EQ(last.number(4), 1U) << "its second message";
  EXPECT_EQ(last.number(8), 1'000'000'007U);
  EXPECT_EQ(last.number(8), 1'000'000'007U);
  EXPECT_EQ(last.rest(), R"({"x":3})");
}

TEST_F(McapFileTest, SaysWhereEachMessageOfEachChunkIs) {
  McapFile file = create();
  const auto a = file.add_channel("/a", {"A", "{}"});
  const auto b = file.add_channel("/b", {"A", "{}"});
  const std::string large = '"' + std::string(300'000, 'x') + '"';  // a chunk of its own
  file.add_message(a, 5ns, "{}");
  file.add_message(b, 6ns, large);
  file.add_message(b, 9ns, "{}");
  ASSERT_TRUE(file.close(0).ok());
  const auto records = mcap_records(bytes(), true);
  std::vector<McapRecord> chunks;
  std::vector<McapRecord> indexes;
  for (const McapRecord& record : records) {
    if (record.op == kChunk || record.op == kChunkIndex) {
      (record.op == kChunk ? chunks : indexes).push_back(record);
    }
  }
  ASSERT_EQ(chunks.size(), 2U);
  ASSERT_EQ(indexes.size(), 2U);
  EXPECT_EQ(unpacked(chunks[0]).size(), 2U);
  EXPECT_EQ(unpacked(chunks[1]).size(), 1U);
  McapBytes index(indexes[0].content);
  EXPECT_EQ(index.number(8), 5U) << "first";
  EXPECT_EQ(index.number(8), 6U) << "last";
  EXPECT_EQ(index.number(8), chunks[0].at);
  EXPECT_EQ(index.number(8), 9 + chunks[0].content.size());
  EXPECT_EQ(index.number(4), 20U) << "bytes of two channels' places";
  std::uint64_t size = 0;
  for (const std::uint64_t channel : {a, b}) {
    EXPECT_EQ(index.number(2), channel);
    const std::uint64_t at = index.number(8);
    const auto found =
        std::find_if(records.begin(), records.end(), [&](const auto& record) { return record.at == at; });
    ASSERT_NE(found, records.end());
    ASSERT_EQ(found->op, kMessageIndex);
    size += 9 + found->content.size();
    McapBytes places(found->content);
    EXPECT_EQ(places.number(2), channel);
    EXPECT_EQ(places.number(4), 16U) << "bytes of one place";
    EXPECT_EQ(places.number(8), channel == a ? 5U : 6U);
    EXPECT_EQ(places.number(8), unpacked(chunks[0])[channel == a ? 0 : 1].at - kMcapMagic.size());
  }
  EXPECT_EQ(index.number(8), size) << "of all message indexes";
  EXPECT_EQ(index.text(), "");
  EXPECT_EQ(index.number(8), chunks[0].content.size() - kBeforeCrc - 4 - 4 - 8);
}

TEST_F(McapFileTest, EndsWithASummaryThatTellsWhereAndHowMuch) {
  McapFile file = create();
  const auto a = file.add_channel("/a", {"A", "{}"});
  (void)file.add_channel("/b", {"B", "{}"});
  file.add_message(a, 5ns, "{}");
  file.add_message(a, 8ns, "{}");
  ASSERT_TRUE(file.close(0).ok());
  const auto records = mcap_records(bytes(), true);
  const std::vector<int> tail{15, kSchema, kSchema, kChannel, kChannel, 11, kChunkIndex, 14, 14, 14, 14, 2};
  const auto all = ops(records);
  const std::size_t end = all.size() - tail.size();
  ASSERT_EQ(std::vector<int>(all.begin() + static_cast<std::ptrdiff_t>(end), all.end()), tail);

  McapBytes footer(records.back().content);
  EXPECT_EQ(footer.number(8), records[end + 1].at) << "the summary begins after DataEnd";
  EXPECT_EQ(footer.number(8), records[end + 7].at) << "its offsets";
  EXPECT_EQ(footer.number(4), 0U) << "no checksum";
  McapBytes statistics(records[end + 5].content);
  EXPECT_EQ(statistics.number(8), 2U) << "messages";
  EXPECT_EQ(statistics.number(2), 2U) << "schemas";
  EXPECT_EQ(statistics.number(4), 2U) << "channels";
  EXPECT_EQ(statistics.number(4), 0U) << "attachments";
  EXPECT_EQ(statistics.number(4), 0U) << "metadata";
  EXPECT_EQ(statistics.number(4), 1U) << "chunks";
  EXPECT_EQ(statistics.number(8), 5U) << "first";
  EXPECT_EQ(statistics.number(8), 8U) << "last";
  EXPECT_EQ(statistics.number(4), 20U) << "bytes of two counts";
  EXPECT_EQ(statistics.number(2), a);
  EXPECT_EQ(statistics.number(8), 2U);
  McapBytes channels(records[end + 8].content);
  EXPECT_EQ(channels.number(1), kChannel);
  EXPECT_EQ(channels.number(8), records[end + 3].at);
  EXPECT_EQ(channels.number(8), records[end + 5].at - records[end + 3].at);
}

TEST_F(McapFileTest, IsReplacedByTheNextLogAndByNothingElse) {
  EXPECT_TRUE(create().close(0).ok());
  EXPECT_TRUE(create().close(0).ok());
  (void)folder_.put("run.mcap", "\x89PNG");
  const Result<McapFile> file = McapFile::create(path());
  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().message,
            path() + ": is there already and is no log of messages; expected a new file, or a log to replace");
}

TEST_F(McapFileTest, WhereAnotherRunGoesOnTheEarlierLogsAreSetAside) {
  EXPECT_TRUE(create().close(0).ok());
  const std::string earlier = bytes();
  for (const char* aside : {"run.previous.mcap", "run.previous-2.mcap"}) {
    Result<McapFile> file = McapFile::create(path(), RecordFile::Earlier::kSetAside);
    ASSERT_TRUE(file.ok());
    file.value().write_out();
    EXPECT_EQ(file.value().where(), path() + ", the one before in " + folder_.path(aside));
    EXPECT_EQ(std::filesystem::file_size(folder_.path(aside)), earlier.size());
    EXPECT_FALSE(McapFile::create(path()).ok()) << "it is locked as every other";
    EXPECT_TRUE(file.value().close(0).ok());
  }
  EXPECT_EQ(bytes(), earlier);
}

TEST_F(McapFileTest, NothingIsSetAsideForAnEmptyFileAndNothingThatIsNoLog) {
  for (const char* text : {"", "\x89PNG"}) {
    (void)folder_.put("run.mcap", text);
    EXPECT_EQ(McapFile::create(path(), RecordFile::Earlier::kSetAside).ok(), *text == '\0');
    EXPECT_FALSE(std::filesystem::exists(folder_.path("run.previous.mcap")));
  }
}

TEST_F(McapFileTest, LeavesWhatWasThereUntilItIsWritten) {
  (void)create();
  EXPECT_FALSE(std::filesystem::exists(path())) << "a run that is refused leaves no empty log";
  EXPECT_TRUE(create().close(0).ok());
  const std::string earlier = bytes();
  for (const auto kind : {RecordFile::Earlier::kReplaced, RecordFile::Earlier::kSetAside}) {
    EXPECT_TRUE(McapFile::create(path(), kind).ok());
    EXPECT_EQ(bytes(), earlier);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("run.previous.mcap")));
  }
}

TEST_F(McapFileTest, EndsWithAWholeChunkWhenTheDiskIsFull) {
  for (rlim_t room = 150; room < 650; room += 41) {
    std::filesystem::remove(path());
    McapFile file = create();
    const auto channel = file.add_channel("/a", {"A", "{}"});
    const SmallDisk disk(room);
    for (int i = 0; i < 8; ++i) {
      file.add_message(channel, 1s * i, "{}");
    }
    file.write_out();
    EXPECT_FALSE(file.close(0).ok());
    std::uint64_t kept = 0;
    for (const McapRecord& record : mcap_records(bytes(), false)) {
      kept += record.op == kChunk ? unpacked(record).size() : 0;
    }
    EXPECT_EQ(file.messages(), kept) << room;
    EXPECT_LT(kept, 8U);
  }
}

TEST(Base64, WritesBytesAsRfc4648Does) {
  const auto text = [](std::string_view bytes) { return base64(std::as_bytes(std::span(bytes))); };
  EXPECT_EQ(text(""), "");
  EXPECT_EQ(text("f"), "Zg==");
  EXPECT_EQ(text("fo"), "Zm8=");
  EXPECT_EQ(text("foo"), "Zm9v");
  EXPECT_EQ(text("foob"), "Zm9vYg==");
  EXPECT_EQ(text("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace ivo::firmware
