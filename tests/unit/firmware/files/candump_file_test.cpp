#include "firmware/files/candump_file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <utility>
#include <vector>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""us;
using std::chrono_literals::operator""s;

using Frames = std::vector<std::pair<Instant, hal::CanFrame>>;

struct Read {
  CandumpContents contents;
  Frames frames;
  std::string message;
};

Read read(const std::string& text) {
  const ScratchFolder folder;
  const std::string path = folder.put("bus.log", text);
  Read read;
  const auto result =
      read_candump(path, [&](Instant at, const hal::CanFrame& frame) { read.frames.emplace_back(at, frame); });
  if (result.ok()) {
    read.contents = result.value();
  } else {
    read.message = replaced(result.error().message, folder.path() + "/", "");
  }
  return read;
}

TEST(CandumpFile, GivesEachFrameWithItsTime) {
  const Read log = read("(1436509052.249713) can0 181#112233445566\n(1436509052.249714) can0 080#\n");
  ASSERT_EQ(log.frames.size(), 2U) << log.message;
  EXPECT_EQ(log.frames[0].first, Instant(1'436'509'052s + 249'713us));
  const hal::CanFrame feedback{.id = 0x181, .size = 6, .data = {0x11, 0x22, 0x33, 0x44, 0x55, 0x66}};
  EXPECT_EQ(log.frames[0].second, feedback);
  EXPECT_EQ(log.frames[1].second, (hal::CanFrame{.id = 0x080, .size = 0, .data = {}}));
  EXPECT_EQ(log.contents.interface, "can0");
  EXPECT_EQ(log.contents.frames, 2U);
}

TEST(CandumpFile, CountsWhatIsNoFrameOfThisBus) {
  const Read log = read(
      "(0000000000.000000) vcan0 080#\n"
      "(0000000000.000000) vcan0 00000123#11\n"                // 29 bits
      "(0000000000.000000) vcan0 181#R\n"                      // remote
      "(0000000000.000000) vcan0 181##1112233\n"               // FD
      "(0000000000.000000) vcan0 20000040#0000000000000000\n"  // error
      "(0000000000.000000) vcan1 080#\n");
  EXPECT_EQ(log.message, "");
  EXPECT_EQ(log.contents.frames, 1U);
  EXPECT_EQ(log.contents.others, 4U);
  EXPECT_EQ(log.contents.elsewhere, 1U);
}

TEST(CandumpFile, TakesTheDirectionThatLaterVersionsAdd) {
  EXPECT_EQ(read("(0000000000.000000) vcan0 080# T\n").contents.frames, 1U);
}

TEST(CandumpFile, OfNothingIsEmpty) {
  const Read log = read("");
  EXPECT_EQ(log.message, "");
  EXPECT_EQ(log.contents.frames, 0U);
}

TEST(CandumpFile, RefusesALineThatIsNoneByItsNumber) {
  for (const std::string line :
       {"hello", "(1.5) can0 080#", "(1.000000) can0", "(1.000000) can0 080", "(1.000000) can0 80#",
        "(1.000000) can0 0G0#", "(1.000000) can0 080#1", "(1.000000) can0 080#112233445566778899",
        "(1.000000) can0 080#-1", "(1.000000) can0 FFF#", "(1.000000 can0 080#", "(-1.000000) can0 080#",
        "(99999999999999999999.000000) can0 080#", "(99999999999.000000) can0 080#", "  "}) {
    EXPECT_EQ(read("(0000000000.000000) can0 080#\n" + line + "\n").message,
              "bus.log:2: no line of a record of frames; expected one as \"(1436509052.249713) can0 "
              "181#112233445566\"")
        << line;
  }
}

TEST(CandumpFile, RefusesWhatCannotBeRead) {
  const auto ignore = [](Instant /*at*/, const hal::CanFrame& /*frame*/) {};
  EXPECT_EQ(message_of(read_candump("/nowhere/bus.log", ignore)),
            "/nowhere/bus.log: cannot be read: No such file or directory");
  EXPECT_EQ(message_of(read_candump("/", ignore)), "/: cannot be read: it is a folder; expected a file");
}

}  // namespace
}  // namespace ivo::firmware
