#include "firmware/files/eds_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "drivers/eds/shipped_eds.hpp"
#include "firmware/files/robot_file.hpp"
#include "firmware/files/text_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"

namespace ivo::firmware {
namespace {

const std::string kConfig = std::string(IVO_SOURCE_DIR) + "/config/";

TEST(EdsFile, TheShippedFilesAreThoseThatAreCompiledIn) {
  EXPECT_EQ(read_file(kConfig + "eds/ivo_drive.eds").value(), drivers::ivo_drive_eds_text());
  EXPECT_EQ(read_file(kConfig + "eds/fixed_mapping_drive.eds").value(), drivers::fixed_mapping_drive_eds_text());
}

TEST(EdsFile, RefusesByPathLineSectionAndKey) {
  const ScratchFolder folder;
  EXPECT_NE(message_of(read_eds_file(folder.path("none.eds"))).find("none.eds: cannot be read"), std::string::npos);
  EXPECT_EQ(message_of(read_eds_file(folder.put("bad.eds", "[1000]\nParameterName=D\nDataType=x\nAccessType=ro\n"))),
            folder.path("bad.eds") +
                ":3: [1000] DataType: \"x\" is no number; expected decimal, 0x and hexadecimal, or 0 and octal");
}

TEST(EdsFile, RefusesToSimulateWhatIsNoWheelDrive) {
  const ScratchFolder folder;
  const std::string text = replaced(std::string(drivers::ivo_drive_eds_text()), "[60FF]", "[60FE]");
  const std::string listed = replaced(text, "=0x60FF", "=0x60FE");
  EXPECT_EQ(message_of(read_simulated_eds(folder.put("d.eds", listed))),
            folder.path("d.eds") +
                ": no object 60FFh that is a number; expected it of a wheel drive that is to be simulated");
}

/// config/robots/ivo.toml with an EDS for the rear left drive, in a folder beside the EDS's.
class RobotWithEds : public testing::Test {
 protected:
  std::string complaint(const std::string& eds) {
    folder_.put("drive.eds", eds);
    const std::string robot = read_file(kConfig + "robots/ivo.toml").value();
    const std::string path =
        folder_.put("r.toml", replaced(robot, "[drive.rear_left]\n", "[drive.rear_left]\neds = \"drive.eds\"\n"));
    const Result<Robot> read = read_robot(path);
    eds_ = read.ok() ? read.value().drives[2].eds : "";
    return message_of(read);
  }
  ScratchFolder folder_;
  std::string eds_;
};

TEST_F(RobotWithEds, IsReadWhenTheDriveHasWhatStartUpTellsIt) {
  EXPECT_EQ(complaint(std::string(drivers::ivo_drive_eds_text())), "fine");
  EXPECT_EQ(eds_, folder_.path("drive.eds")) << "from the robot file's folder";
}

TEST_F(RobotWithEds, IsRefusedByLineDriveFileObjectAndStep) {
  const std::string text(drivers::ivo_drive_eds_text());
  const std::size_t at = text.find("AccessType=rw", text.find("[1017]"));
  const std::string read_only = text.substr(0, at) + "AccessType=ro" + text.substr(at + 13);
  const std::string message = complaint(read_only);
  EXPECT_NE(message.find("r.toml:"), std::string::npos) << message;
  EXPECT_NE(message.find(": drive.rear_left.eds: " + folder_.path("drive.eds") +
                         ": object 1017h is read-only; expected it writable, for \"producer heartbeat time 1017h\""),
            std::string::npos)
      << message;
}

TEST_F(RobotWithEds, IsRefusedWithABrokenEds) {
  const std::string message = complaint("[1000\n");
  EXPECT_NE(
      message.find(": drive.rear_left.eds: " + folder_.path("drive.eds") + ":1: \"[1000\"; expected ] at its end"),
      std::string::npos)
      << message;
}

}  // namespace
}  // namespace ivo::firmware
