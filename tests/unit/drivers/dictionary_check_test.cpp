#include "drivers/eds/dictionary_check.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "drivers/eds/dictionary_check_text.hpp"
#include "drivers/eds/eds_error_text.hpp"
#include "drivers/eds/eds_reader.hpp"
#include "drivers/eds/shipped_eds.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

StartupSteps steps() { return startup_steps(test_robot(), Wheel::kFrontLeft); }

std::string replaced(std::string text, const std::string& after, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from, text.find(after));
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// What is found in an EDS, one a line.
std::string findings(const std::string& text) {
  const auto eds = std::make_unique<EdsDictionary>();
  const auto error = read_eds(text, *eds);
  EXPECT_FALSE(error.has_value()) << describe(*error);
  std::string all;
  for (const DictionaryFinding& finding : check_dictionary(*eds, steps(), 1)) {
    all += describe(finding) + "\n";
  }
  return all;
}

/// In the shipped EDS with `from` in the section `section` replaced.
std::string findings(const std::string& section, const std::string& from, const std::string& to) {
  return findings(replaced(std::string(ivo_drive_eds_text()), "[" + section + "]", from, to));
}

TEST(DictionaryCheck, FindsNothingWrongWithTheShippedDrive) { EXPECT_EQ(findings("1000", "0x1", "0x1"), ""); }

TEST(DictionaryCheck, FindsNothingWrongWithAFixedMappingThatIsRightAsItIs) {
  EXPECT_EQ(findings(std::string(fixed_mapping_drive_eds_text())), "");
}

TEST(DictionaryCheck, FindsAFixedMappingThatIsNotWhatIsNeeded) {
  const std::string text(fixed_mapping_drive_eds_text());
  const std::string other = findings(replaced(text, "[1603sub2]", "0x60FF0020", "0x607F0020"));
  EXPECT_EQ(other.substr(0, 84),
            "object 1400h:1 is read-only; expected it writable, for \"disable RPDO1 1400h:1\"\nobjec");
  EXPECT_EQ(other.find("TPDO"), std::string::npos) << "feedback is right as it is";
  EXPECT_NE(findings(replaced(text, "[1403sub2]", "AccessType=rw", "AccessType=ro")), "") << "its type is 255";
}

TEST(DictionaryCheck, FindsThatTargetsCannotBeShared) {
  Robot robot = test_robot();
  robot.pdo_layout = PdoLayout::kShared;
  const auto eds = std::make_unique<EdsDictionary>();
  std::string text(ivo_drive_eds_text());
  ASSERT_FALSE(read_eds(text, *eds).has_value());
  EXPECT_TRUE(check_dictionary(*eds, startup_steps(robot, Wheel::kFrontRight), 2).empty());
  text = replaced(replaced(text, "[DummyUsage]", "Dummy0004=1", "Dummy0004=0"), "[DummyUsage]", "Dummy0007=1",
                  "Dummy0007=0");
  ASSERT_FALSE(read_eds(text, *eds).has_value());
  const DictionaryFindings found = check_dictionary(*eds, startup_steps(robot, Wheel::kFrontRight), 2);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(describe(found[0]).substr(0, 74),
            "object 1601h:1 is to map 0007h with 32 bits; expected it mappable so, for ");
}

TEST(DictionaryCheck, FindsAnObjectThatIsMissing) {
  const std::string text = replaced(std::string(ivo_drive_eds_text()), "[OptionalObjects]", "=0x60FF", "=0x60FE");
  EXPECT_EQ(findings(replaced(text, "[60FF]", "[60FF]", "[60FE]")).substr(0, 39),
            "object 60FFh is missing; expected it, f");
}

TEST(DictionaryCheck, FindsAnotherSize) {
  EXPECT_EQ(findings("1017", "DataType=0x0006", "DataType=0x0007"),
            "object 1017h has 4 bytes; expected 2, for \"producer heartbeat time 1017h\"\n");
}

TEST(DictionaryCheck, FindsWhatCannotBeWrittenOrRead) {
  EXPECT_EQ(findings("1016sub1", "AccessType=rw", "AccessType=ro").substr(0, 56),
            "object 1016h:1 is read-only; expected it writable, for \"");
  EXPECT_EQ(findings("6061", "AccessType=ro", "AccessType=wo"),
            "object 6061h is write-only; expected it readable, for \"mode of operation 6061h\"\n");
}

TEST(DictionaryCheck, FindsLimitsThatForbidWhatWillBeWritten) {
  EXPECT_EQ(findings("1017", "PDOMapping=0", "PDOMapping=0\nHighLimit=40"),
            "object 1017h takes no more than 40; expected it to take 50, for \"producer heartbeat time 1017h\"\n");
  EXPECT_EQ(findings("1017", "PDOMapping=0", "PDOMapping=0\nLowLimit=100"),
            "object 1017h takes no less than 100; expected it to take 50, for \"producer heartbeat time 1017h\"\n");
}

TEST(DictionaryCheck, FindsWhatCannotBeMapped) {
  // Neither is one of the drive's PDOs right as it is.
  std::string text = replaced(std::string(ivo_drive_eds_text()), "[1603sub2]", "0x60FF0020", "0x607F0020");
  text = replaced(text, "[1A02sub2]", "0x60640020", "0x606C0020");
  EXPECT_EQ(findings(text), "");
  EXPECT_EQ(findings(replaced(text, "[60FF]", "PDOMapping=1", "PDOMapping=0")).substr(0, 82),
            "object 1600h:2 is to map 60FFh with 32 bits; expected it mappable so, for \"map tar");
  EXPECT_EQ(findings(replaced(text, "[6064]", "AccessType=ro", "AccessType=rww")).substr(0, 39),
            "object 1A00h:2 is to map 6064h with 32 ")
      << "into a TPDO";
}

TEST(DictionaryCheck, FindsConstantsThatStartUpWillNotAccept) {
  EXPECT_EQ(findings("1000", "DefaultValue=0x00020192", "DefaultValue=0x00020191"),
            "object 1000h is always 00000191h; expected 00000192h, for \"device type 1000h\"\n");
  EXPECT_EQ(findings("6502", "DefaultValue=0x00000104", "DefaultValue=0x00000021"),
            "object 6502h is always 00000021h; expected a velocity mode, bit 2 or bit 8, for \"supported drive modes "
            "6502h\"\n");
}

TEST(DictionaryCheck, PassesOverWhatADriveMayRefuse) {
  for (const StartupStep& step : steps()) {
    if (step.may_refuse && step.object.sub == 0) {
      const std::string section = text_of(step.object).substr(0, 4);
      const std::string all = findings(section, "AccessType=rw", "AccessType=ro");
      EXPECT_EQ(all.find(std::string("\"") + step.name + "\""), std::string::npos) << all;
    }
  }
}

}  // namespace
}  // namespace ivo::drivers
