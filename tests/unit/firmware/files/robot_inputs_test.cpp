#include "firmware/files/robot_inputs.hpp"

#include <gtest/gtest.h>

#include "firmware/files/robot_file.hpp"
#include "firmware/files/text_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"

namespace ivo::firmware {
namespace {

const std::string kInputs =
    "[inputs]\n"                                           // 1
    "chip = 'gpiochip0'\n"                                 // 2
    "emergency_stop = { line = 17, active_low = true }\n"  // 3
    "bumpers = [{ line = 22, active_low = false },\n"      // 4
    "           { line = 27, active_low = true }]\n";      // 5

Result<InputParameters> read(const std::string& text) {
  const Result<TomlFile> toml = TomlFile::parse(text, "r.toml");
  if (!toml) {
    return toml.error();
  }
  InputParameters inputs = read_inputs(toml.value().root().optional("inputs"));
  const Result<void> finish = toml.value().finish();
  if (!finish) {
    return finish.error();
  }
  return inputs;
}

std::string complaint_about_inputs(std::string_view from, std::string_view to) {
  return message_of(read(replaced(kInputs, from, to)));
}

TEST(RobotInputs, ReadsEveryField) {
  const auto inputs = read(kInputs);
  ASSERT_TRUE(inputs.ok()) << inputs.error().message;
  EXPECT_EQ(inputs.value().chip, "gpiochip0");
  EXPECT_EQ(inputs.value().emergency_stop, (InputLine{.line = 17, .active_low = true}));
  EXPECT_EQ(inputs.value().bumpers[0], (InputLine{.line = 22, .active_low = false}));
  EXPECT_EQ(inputs.value().bumpers[1], (InputLine{.line = 27, .active_low = true}));
  EXPECT_FALSE(inputs.value().bumpers[2]);
}

TEST(RobotInputs, WithoutATableThereAreNone) {
  const auto inputs = read("");
  ASSERT_TRUE(inputs.ok());
  EXPECT_EQ(inputs.value(), InputParameters{});
}

TEST(RobotInputs, EitherKindWillDo) {
  EXPECT_TRUE(read("[inputs]\nchip = '0'\nbumpers = [{ line = 0, active_low = true }]\n").ok());
  EXPECT_TRUE(read("[inputs]\nchip = '0'\nemergency_stop = { line = 0, active_low = true }\n").ok());
  EXPECT_EQ(message_of(read("[inputs]\nchip = '0'\n")),
            "r.toml:1: inputs: has no input; expected emergency_stop, bumpers or both, or no such table");
}

TEST(RobotInputs, RefusesALineThatIsUsedTwice) {
  EXPECT_EQ(complaint_about_inputs("line = 27", "line = 17"),
            "r.toml:5: inputs.bumpers[1].line: 17 is already inputs.emergency_stop's; expected a line of its own");
  EXPECT_EQ(complaint_about_inputs("line = 27", "line = 22"),
            "r.toml:5: inputs.bumpers[1].line: 22 is already inputs.bumpers[0]'s; expected a line of its own");
}

TEST(RobotInputs, RefusesALevelThatIsNotSaid) {
  EXPECT_EQ(complaint_about_inputs("line = 17, active_low = true", "line = 17"),
            "r.toml:3: inputs.emergency_stop.active_low: missing; it must be given");
}

TEST(RobotInputs, RefusesLinesThatCannotBe) {
  EXPECT_EQ(complaint_about_inputs("line = 22", "line = -1"),
            "r.toml:4: inputs.bumpers[0].line: -1 is out of range; expected 0 to 1023");
  EXPECT_EQ(complaint_about_inputs("line = 22", "pin = 22"),
            "r.toml:4: inputs.bumpers[0].pin: unknown; did you mean line?");
  EXPECT_EQ(complaint_about_inputs("chip = 'gpiochip0'\n", ""), "r.toml:1: inputs.chip: missing; it must be given");
}

TEST(RobotInputs, RefusesMoreBumpersThanThereIsRoomFor) {
  std::string eight = "bumpers = [";
  for (int i = 0; i < 8; ++i) {
    eight += "{ line = " + std::to_string(i) + ", active_low = true }, ";
  }
  EXPECT_EQ(message_of(read("[inputs]\nchip = '0'\n" + eight + "]\n")),
            "r.toml:3: inputs.bumpers: has 8 elements; expected a list of 1 to 7 bumpers");
}

// The table that the shipped file shows is one that can be used.
TEST(RobotInputs, ReadsWhatTheShippedRobotFileShows) {
  const auto shipped = read_file(std::string(IVO_SOURCE_DIR) + "/config/robots/ivo.toml");
  ASSERT_TRUE(shipped.ok());
  std::string text = shipped.value();
  std::size_t at = text.find("# [inputs]\n");
  ASSERT_NE(at, std::string::npos);
  for (; at != std::string::npos; at = text.find("\n# ", at)) {
    text.erase(text[at] == '\n' ? at + 1 : at, 2);
  }
  const ScratchFolder folder;
  const auto robot = read_robot(folder.put("ivo.toml", text));
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  EXPECT_EQ(robot.value().inputs.chip, "gpiochip0");
  EXPECT_TRUE(robot.value().inputs.emergency_stop && robot.value().inputs.bumpers[1]);
}

}  // namespace
}  // namespace ivo::firmware
