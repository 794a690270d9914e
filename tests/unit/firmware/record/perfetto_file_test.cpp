#include "firmware/record/perfetto_file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/protobuf.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_disk.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""us;

class PerfettoFileTest : public testing::Test {
 protected:
  std::string path() const { return folder_.path("run.perfetto"); }
  PerfettoFile create() const {
    Result<PerfettoFile> file = PerfettoFile::create(path(), "ivo");
    EXPECT_TRUE(file.ok());
    return std::move(file).value();
  }
  std::string refusal() const {
    const Result<PerfettoFile> file = PerfettoFile::create(path(), "ivo");
    return file.ok() ? "taken" : file.error().message;
  }
  std::vector<ProtoMessage> packets() const {
    std::ostringstream text;
    text << std::ifstream(path(), std::ios::binary).rdbuf();
    const std::string bytes = text.str();
    std::vector<ProtoMessage> packets;
    for (const ProtoMessage::Field& field : ProtoMessage(bytes).fields) {
      EXPECT_EQ(field.number, 1U) << "Trace.packet";
      packets.emplace_back(field.bytes);
    }
    return packets;
  }
  std::vector<ProtoMessage> events() const {
    std::vector<ProtoMessage> events;
    for (const ProtoMessage& packet : packets()) {
      if (packet.has(11)) {
        events.push_back(packet.message(11));
      }
    }
    return events;
  }

  ScratchFolder folder_;
};

TEST_F(PerfettoFileTest, BeginsWithAClearedSequenceAndTheProcess) {
  PerfettoFile file = create();
  file.write_out();
  const auto all = packets();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].number(13), 1U) << "sequence_flags: incremental state cleared";
  const ProtoMessage track = all[1].message(60);
  EXPECT_EQ(track.number(1), 1U) << "uuid";
  EXPECT_EQ(track.message(3).text(6), "ivo") << "process_name";
  for (const ProtoMessage& packet : all) {
    EXPECT_EQ(packet.number(10), 1U) << "all of one sequence";
  }
}

TEST_F(PerfettoFileTest, ShowsTracksInTheOrderInWhichTheyAreMade) {
  PerfettoFile file = create();
  const auto cycle = file.add_track("cycle");
  const auto took = file.add_track("took", PerfettoFile::Unit::kNanoseconds);
  file.write_out();
  const auto all = packets();
  ASSERT_EQ(all.size(), 4U);
  const ProtoMessage first = all[2].message(60);
  const ProtoMessage second = all[3].message(60);
  EXPECT_EQ(first.number(1), cycle);
  EXPECT_EQ(first.text(2), "cycle");
  EXPECT_EQ(first.number(5), 1U) << "of the process";
  EXPECT_FALSE(first.has(8));
  EXPECT_EQ(second.number(1), took);
  EXPECT_EQ(second.message(8).number(3), 1U) << "a counter in nanoseconds";
  EXPECT_LT(first.number(12), second.number(12)) << "rank";
}

TEST_F(PerfettoFileTest, SaysEachNameOnceAndItsNumberFromThenOn) {
  PerfettoFile file = create();
  const auto track = file.add_track("cycle");
  file.begin_slice(track, Instant(5us), "think", {{"units", std::int64_t{300}}, {"why", "because"}});
  file.end_slice(track, Instant(7us));
  file.begin_slice(track, Instant(9us), "think", {{"units", std::int64_t{-1}}});
  file.write_out();
  EXPECT_EQ(file.events(), 2U);
  const auto all = packets();
  ASSERT_EQ(all.size(), 6U);
  const ProtoMessage names = all[3].message(12);
  EXPECT_EQ(names.message(2).number(1), 1U);
  EXPECT_EQ(names.message(2).text(2), "think");
  ASSERT_EQ(names.all(3).size(), 2U);
  EXPECT_EQ(ProtoMessage(names.all(3)[1].bytes).text(2), "why");
  EXPECT_EQ(all[3].number(8), 5000U) << "timestamp";
  const ProtoMessage begin = all[3].message(11);
  EXPECT_EQ(begin.number(9), 1U) << "TYPE_SLICE_BEGIN";
  EXPECT_EQ(begin.number(10), 1U) << "name_iid";
  EXPECT_EQ(begin.number(11), track);
  EXPECT_EQ(ProtoMessage(begin.all(4)[0].bytes).number(4), 300U);
  EXPECT_EQ(ProtoMessage(begin.all(4)[1].bytes).text(6), "because");
  const ProtoMessage end = all[4].message(11);
  EXPECT_EQ(end.number(9), 2U) << "TYPE_SLICE_END";
  EXPECT_FALSE(end.has(10));
  EXPECT_FALSE(all[5].has(12)) << "nothing new";
  EXPECT_EQ(all[5].message(11).number(10), 1U);
  EXPECT_EQ(static_cast<std::int64_t>(all[5].message(11).message(4).number(4)), -1);
  for (std::size_t i = 3; i < all.size(); ++i) {
    EXPECT_EQ(all[i].number(13), 2U) << "needs the names";
  }
}

TEST_F(PerfettoFileTest, CountsAndMarks) {
  PerfettoFile file = create();
  const auto counter = file.add_track("units", PerfettoFile::Unit::kCount);
  const auto track = file.add_track("faults");
  file.count(counter, Instant(1us), 100'000);
  file.instant(track, Instant(2us), "fault");
  file.write_out();
  const auto all = events();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].number(9), 4U) << "TYPE_COUNTER";
  EXPECT_EQ(all[0].number(11), counter);
  EXPECT_EQ(all[0].number(30), 100'000U);
  EXPECT_EQ(all[1].number(9), 3U) << "TYPE_INSTANT";
}

TEST_F(PerfettoFileTest, IsReplacedByTheNextTraceAndByNothingElse) {
  {
    PerfettoFile file = create();
    file.write_out();
    EXPECT_EQ(refusal(), path() + ": another run is writing here; expected a file of its own for each run");
  }
  EXPECT_EQ(refusal(), "taken");
  (void)folder_.put("run.perfetto", "\nformat = 1\n");  // begins with a byte of ours
  EXPECT_EQ(refusal(),
            path() + ": is there already and is no trace of events; expected a new file, or a trace to replace");
  (void)folder_.put("run.perfetto", "\n");
  EXPECT_NE(refusal(), "taken");
}

TEST_F(PerfettoFileTest, EndsWithAWholePacketWhenTheDiskIsFull) {
  for (rlim_t room = 40; room < 140; room += 7) {
    std::filesystem::remove(path());
    PerfettoFile file = create();
    const auto track = file.add_track("faults");
    const SmallDisk disk(room);
    for (int i = 0; i < 10; ++i) {
      file.instant(track, Instant(i * 1us), "fault");
    }
    file.write_out();
    const std::size_t kept = events().size();  // throws on half a packet
    EXPECT_EQ(file.events(), kept) << room;
    const Result<void> closed = file.close(0);
    ASSERT_FALSE(closed.ok());
    EXPECT_EQ(closed.error().message,
              path() + ": the trace ends early, " + std::to_string(10 - kept) + " events are missing: File too large");
  }
}

}  // namespace
}  // namespace ivo::firmware
