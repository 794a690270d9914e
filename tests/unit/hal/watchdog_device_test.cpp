#include "hal/linux/watchdog_device.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "tests/support/scratch_folder.hpp"

namespace ivo::hal {
namespace {

using std::chrono::seconds;

// A file in the place of a device keeps what a device would have been told.
class WatchdogDeviceTest : public testing::Test {
 protected:
  [[nodiscard]] WatchdogDevice running() const {
    return {FileDescriptor(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)), seconds(2)};
  }
  [[nodiscard]] std::string told() const {
    std::stringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }
  static std::string refusal(const std::string& path) {
    const Result<WatchdogDevice> device = WatchdogDevice::open(path, seconds(2));
    return device ? "none" : device.error().message;
  }

  ScratchFolder folder_;
  std::string path_ = folder_.put("watchdog", "");
};

TEST_F(WatchdogDeviceTest, IsFedByAByteThatIsNotTheMagicOne) {
  WatchdogDevice device = running();
  EXPECT_TRUE(device.feed());
  EXPECT_TRUE(device.feed());
  EXPECT_EQ(told(), std::string(2, '\0'));
  EXPECT_EQ(device.timeout(), seconds(2));
}

TEST_F(WatchdogDeviceTest, AnOrderlyEndSaysTheMagicByteLastAndIsTheLast) {
  WatchdogDevice device = running();
  EXPECT_TRUE(device.feed());
  EXPECT_TRUE(device.end());
  EXPECT_EQ(told(), std::string("\0V", 2));
  EXPECT_FALSE(device.feed());
  EXPECT_FALSE(device.end());
  EXPECT_EQ(told(), std::string("\0V", 2));
}

TEST_F(WatchdogDeviceTest, RunsOnWithoutAnOrderlyEnd) {
  {
    WatchdogDevice device = running();
    WatchdogDevice moved = std::move(device);
    EXPECT_TRUE(moved.feed());
  }
  EXPECT_EQ(told(), std::string(1, '\0'));
}

TEST_F(WatchdogDeviceTest, SaysWhenTheDeviceDoesNotTakeItsFood) {
  WatchdogDevice device(FileDescriptor(::open("/dev/full", O_WRONLY | O_CLOEXEC)), seconds(2));
  EXPECT_FALSE(device.feed());
  EXPECT_FALSE(device.end());
}

TEST_F(WatchdogDeviceTest, RefusesAPlainFileAndLeavesItAsItIs) {
  std::ofstream(path_) << "precious";
  EXPECT_EQ(refusal(path_), "watchdog " + path_ + ": not a device; expected one as /dev/watchdog");
  EXPECT_EQ(told(), "precious");
}

TEST_F(WatchdogDeviceTest, RefusesADeviceThatIsNoWatchdog) {
  EXPECT_EQ(refusal("/dev/null"), "watchdog /dev/null: not a watchdog; expected a device as /dev/watchdog");
}

TEST_F(WatchdogDeviceTest, RefusesADeviceThatIsNotThere) {
  EXPECT_EQ(refusal("/dev/no-watchdog"),
            "watchdog /dev/no-watchdog: No such file or directory; expected a device that this user may write to");
}

}  // namespace
}  // namespace ivo::hal
