#include "firmware/record/candump_log.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_disk.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""us;
using std::chrono_literals::operator""s;

class CandumpLogTest : public testing::Test {
 protected:
  std::string path(const std::string& name = "bus.log") const { return folder_.path(name); }
  static std::string contents(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  void put(const std::string& text) const { (void)folder_.put("bus.log", text); }
  void push(int frames) {
    for (int i = 0; i < frames; ++i) {
      ASSERT_TRUE(ring_->push({Instant(i * 1us), {.id = 0x080, .size = 0, .data = {}}}));
    }
  }
  std::string refusal(const std::string& path) const {
    const Result<CandumpLog> log = CandumpLog::create(path, "can0", Duration::zero());
    return log.ok() ? "taken" : log.error().message;
  }

  ScratchFolder folder_;
  std::unique_ptr<FrameRing> ring_ = std::make_unique<FrameRing>();
};

TEST_F(CandumpLogTest, WritesALineAsCandumpDoes) {
  const RecordedFrame frame{Instant(1'436'509'052s + 249'713us),
                            {.id = 0x181, .size = 6, .data = {0x11, 0x22, 0x33, 0x44, 0x55, 0x66}}};
  EXPECT_EQ(candump_line(frame, "can0", Duration::zero()), "(1436509052.249713) can0 181#112233445566\n");
}

TEST_F(CandumpLogTest, WritesSimulatedTimeFromZeroAndFramesWithoutData) {
  EXPECT_EQ(candump_line({Instant{}, {.id = 0x005, .size = 0, .data = {0xFF}}}, "vcan0", Duration::zero()),
            "(0000000000.000000) vcan0 005#\n");
}

TEST_F(CandumpLogTest, WritesTimeOfTheWallWhereTheEpochIsGiven) {
  EXPECT_EQ(candump_line({Instant(2s + 7us), {.id = 0x7FF, .size = 1, .data = {0x0A}}}, "can0", 1'700'000'000s),
            "(1700000002.000007) can0 7FF#0A\n");
}

TEST_F(CandumpLogTest, HasEveryFrameAfterADrainThoughNobodyClosesIt) {
  Result<CandumpLog> log = CandumpLog::create(path(), "can0", Duration::zero());
  ASSERT_TRUE(log.ok()) << log.error().message;
  push(3);
  log.value().drain(*ring_);
  EXPECT_EQ(contents(path()),
            "(0000000000.000000) can0 080#\n(0000000000.000001) can0 080#\n(0000000000.000002) can0 080#\n");
  EXPECT_EQ(log.value().frames(), 3U);
}

TEST_F(CandumpLogTest, ReplacesAnEarlierRecord) {
  put("(0000000000.000000) vcan0 080#\n(0000000000.000000) vcan0 701#00\n");
  Result<CandumpLog> log = CandumpLog::create(path(), "can0", Duration::zero());
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_TRUE(log.value().close(*ring_).ok());
  EXPECT_EQ(contents(path()), "");
}

TEST_F(CandumpLogTest, LeavesAFileThatIsNoRecordAsItIs) {
  put("format = 1\n");
  EXPECT_EQ(refusal(path()),
            path() + ": is there already and is no record of frames; expected a new file, or a record to replace");
  EXPECT_EQ(contents(path()), "format = 1\n");
}

TEST_F(CandumpLogTest, RefusesWhatIsNoFileAndFoldersThatAreNotThere) {
  EXPECT_EQ(refusal(folder_.path()), folder_.path() + ": cannot be written: Is a directory");
  EXPECT_EQ(refusal(path("none/bus.log")), path("none/bus.log") + ": cannot be written: No such file or directory");
  EXPECT_EQ(refusal("/dev/null"), "/dev/null: cannot be written: it is a pipe or a device; expected a file");
}

TEST_F(CandumpLogTest, RefusesAFileThatAnotherRunIsWriting) {
  const Result<CandumpLog> first = CandumpLog::create(path(), "can0", Duration::zero());
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(refusal(path()), path() + ": another run is writing here; expected a file of its own for each run");
}

TEST_F(CandumpLogTest, SaysHowManyFramesTheRingLost) {
  Result<CandumpLog> log = CandumpLog::create(path(), "can0", Duration::zero());
  ASSERT_TRUE(log.ok());
  push(int{kRecordedFrames});
  EXPECT_FALSE(ring_->push({}));
  log.value().drain(*ring_);
  const Result<void> closed = log.value().close(*ring_);
  ASSERT_FALSE(closed.ok());
  EXPECT_EQ(closed.error().message,
            path() + ": 1 frames are missing in between; expected a disk and a terminal that keep up");
  EXPECT_EQ(log.value().frames(), kRecordedFrames);
}

// A line is 30 bytes; each of these ends the disk at another place in it.
TEST_F(CandumpLogTest, EndsWithAWholeLineWhenTheDiskIsFull) {
  for (const rlim_t room : {rlim_t{0}, rlim_t{1}, rlim_t{29}, rlim_t{30}, rlim_t{31}, rlim_t{75}, rlim_t{90}}) {
    std::filesystem::remove(path());
    Result<CandumpLog> log = CandumpLog::create(path(), "can0", Duration::zero());
    ASSERT_TRUE(log.ok());
    const SmallDisk disk(room);
    push(2);
    log.value().drain(*ring_);
    push(5);
    log.value().drain(*ring_);
    const std::uint64_t whole = room / 30;
    EXPECT_EQ(contents(path()).size(), 30 * whole) << room;
    EXPECT_EQ(log.value().frames(), whole) << room;
    const Result<void> closed = log.value().close(*ring_);
    ASSERT_FALSE(closed.ok());
    EXPECT_EQ(closed.error().message,
              path() + ": the record ends early, " + std::to_string(7 - whole) + " frames are missing: File too large");
  }
}

TEST_F(CandumpLogTest, GoesOnCountingWhenThereIsRoomAgainButWritesNoMore) {
  Result<CandumpLog> log = CandumpLog::create(path(), "can0", Duration::zero());
  ASSERT_TRUE(log.ok());
  {
    const SmallDisk disk(31);
    push(2);
    log.value().drain(*ring_);
  }
  push(2);
  log.value().drain(*ring_);
  EXPECT_EQ(contents(path()), "(0000000000.000000) can0 080#\n");
  EXPECT_FALSE(log.value().close(*ring_).ok());
}

}  // namespace
}  // namespace ivo::firmware
