#include "firmware/tools/supervisor.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hal/sim/manual_clock.hpp"
#include "tests/support/listening_manager.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ivo::firmware {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Messages = std::vector<std::string>;

constexpr const char* kTimeoutUs = "1000000";
const Messages kFirst{"READY=1", "WATCHDOG=1"};
const Messages kAlive{"WATCHDOG=1"};

class SupervisorTest : public testing::Test {
 protected:
  SupervisorTest() { ListeningManager::watch(kTimeoutUs); }
  ~SupervisorTest() override { ListeningManager::forget(); }

  static hal::ServiceNotify opened() {
    Result<hal::ServiceNotify> notify = hal::ServiceNotify::open();
    EXPECT_TRUE(notify) << notify.error().message;
    return std::move(notify).value();
  }
  // A file in the place of a device.
  [[nodiscard]] hal::WatchdogDevice device(Duration timeout = seconds(2)) const {
    return {hal::FileDescriptor(::open(device_path_.c_str(), O_WRONLY | O_CLOEXEC)), timeout};
  }
  [[nodiscard]] std::string told() const {
    std::stringstream text;
    text << std::ifstream(device_path_).rdbuf();
    return text.str();
  }
  std::function<std::uint64_t()> counter() {
    return [this] { return cycles_.load(); };
  }

  ListeningManager manager_{ListeningManager::some_name()};
  ScratchFolder folder_;
  std::string device_path_ = folder_.put("device", "");
  std::atomic<std::uint64_t> cycles_{0};
};

TEST_F(SupervisorTest, IsReadyOnceTheLoopHasMadeACycleAndNotBefore) {
  Supervisor supervisor(counter(), opened());
  supervisor.look();
  EXPECT_EQ(manager_.heard(), Messages{});
  ++cycles_;
  supervisor.look();
  EXPECT_EQ(manager_.heard(), kFirst);
  ++cycles_;
  supervisor.look();
  EXPECT_EQ(manager_.heard(), kAlive);
}

TEST_F(SupervisorTest, DoesNotVouchForALoopThatHangs) {
  Supervisor supervisor(counter(), opened(), device());
  ++cycles_;
  supervisor.look();
  ASSERT_EQ(manager_.heard(), kFirst);
  for (int look = 0; look < 100; ++look) {
    supervisor.look();
  }
  EXPECT_EQ(manager_.heard(), Messages{});
  EXPECT_EQ(told(), std::string(1, '\0'));
}

TEST_F(SupervisorTest, VouchesAgainForALoopThatGoesOn) {
  Supervisor supervisor(counter(), opened(), device());
  ++cycles_;
  supervisor.look();
  supervisor.look();
  ++cycles_;
  supervisor.look();
  EXPECT_EQ(manager_.heard(), (Messages{"READY=1", "WATCHDOG=1", "WATCHDOG=1"}));
  EXPECT_EQ(told(), std::string(2, '\0'));
}

// A loop of 500 Hz that hangs at some time, in a clock that only the test moves: it is vouched for well within the
// timeout as long as it lives, and for the last time no later than at the next look.
TEST_F(SupervisorTest, TheManagerWaitsForNothingWhileTheLoopLivesAndInVainAfterwards) {
  for (const int hangs_after_ms : {1, 250, 1000, 1503, 7777}) {
    cycles_ = 0;
    ListeningManager::watch(kTimeoutUs);
    setenv("NOTIFY_SOCKET", ListeningManager::some_name().c_str(), 1);
    Supervisor supervisor(counter(), opened());
    const Duration timeout = seconds(1);
    const Instant hangs(milliseconds{hangs_after_ms});
    hal::ManualClock clock;
    Instant last_vouched{};
    while (clock.now() < Instant(seconds(20))) {
      clock.sleep_until(clock.now() + supervisor.look_every());
      cycles_ = static_cast<std::uint64_t>(std::min(clock.now(), hangs).time_since_epoch() / milliseconds(2)) + 1;
      supervisor.look();
      if (!manager_.heard().empty()) {
        EXPECT_LE(clock.now() - last_vouched, timeout / 2);
        last_vouched = clock.now();
      }
    }
    EXPECT_GE(last_vouched, hangs);
    EXPECT_LE(last_vouched, hangs + supervisor.look_every());
  }
}

TEST_F(SupervisorTest, LooksFourTimesWithinTheShortestTimeout) {
  EXPECT_EQ(Supervisor(counter(), opened(), device(seconds(2))).look_every(), milliseconds(250));
  EXPECT_EQ(Supervisor(counter(), hal::ServiceNotify(), device(seconds(2))).look_every(), milliseconds(500));
}

TEST_F(SupervisorTest, LooksBeforeAShortDeviceTimeoutEndsToo) {
  EXPECT_EQ(Supervisor(counter(), opened(), device(milliseconds(400))).look_every(), milliseconds(100));
}

TEST_F(SupervisorTest, AnOrderlyEndIsSaidAndEndsTheDevice) {
  Supervisor supervisor(counter(), opened(), device());
  ++cycles_;
  supervisor.look();
  supervisor.stop();
  EXPECT_EQ(manager_.heard(), (Messages{"READY=1", "WATCHDOG=1", "STOPPING=1"}));
  EXPECT_EQ(told(), std::string("\0V", 2));
  EXPECT_EQ(supervisor.lost(), 0U);
}

TEST_F(SupervisorTest, AnEndThatNobodyOrderedLeavesTheDeviceRunning) {
  {
    Supervisor supervisor(counter(), opened(), device());
    supervisor.start();
    ++cycles_;
    ASSERT_EQ(manager_.next(), "READY=1");
    ASSERT_EQ(manager_.next(), "WATCHDOG=1");
  }
  EXPECT_EQ(manager_.heard(), Messages{});
  EXPECT_EQ(told().find('V'), std::string::npos);
}

TEST_F(SupervisorTest, ItsOwnThreadVouchesForALoopInAnotherUntilItIsStopped) {
  ListeningManager::watch("20000");
  Supervisor supervisor(counter(), opened(), device());
  std::atomic<bool> running{true};
  std::thread loop([&] {
    while (running.load()) {
      ++cycles_;
      std::this_thread::yield();
    }
  });
  supervisor.start();
  supervisor.start();  // once
  EXPECT_EQ(manager_.next(), "READY=1");
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(manager_.next(), "WATCHDOG=1");
  }
  running.store(false);
  loop.join();
  (void)manager_.heard();  // a socket that is full would lose the last word
  supervisor.stop();
  const Messages rest = manager_.heard();
  ASSERT_FALSE(rest.empty());
  EXPECT_EQ(rest.back(), "STOPPING=1");
  EXPECT_EQ(told().back(), 'V');
}

TEST_F(SupervisorTest, SaysHowItIsInOneLine) {
  Supervisor supervisor(counter(), opened());
  supervisor.say("awaiting consent");
  EXPECT_EQ(manager_.heard(), Messages{"STATUS=awaiting consent"});
}

TEST_F(SupervisorTest, CountsFoodThatTheDeviceRefuses) {
  Supervisor supervisor(
      counter(), opened(),
      hal::WatchdogDevice(hal::FileDescriptor(::open("/dev/full", O_WRONLY | O_CLOEXEC)), seconds(2)));
  ++cycles_;
  supervisor.look();
  EXPECT_EQ(supervisor.lost(), 1U);
  supervisor.stop();
  EXPECT_EQ(supervisor.lost(), 2U);
}

TEST_F(SupervisorTest, NeedsNobodyWhoListens) {
  Supervisor supervisor(counter(), hal::ServiceNotify());
  supervisor.start();
  ++cycles_;
  supervisor.stop();
  EXPECT_EQ(manager_.heard(), Messages{});
}

TEST_F(SupervisorTest, ALoopThatHasEndedInOrderIsNoLongerWatchedHoweverLongItsResultsTake) {
  std::atomic<bool> ended{false};
  Supervisor supervisor([&] { return ended.load() ? std::nullopt : std::optional(cycles_.load()); }, opened(),
                        device());
  ++cycles_;
  supervisor.look();
  EXPECT_EQ(manager_.heard(), kFirst);
  ended = true;
  supervisor.look();
  EXPECT_EQ(manager_.heard(), Messages{"STOPPING=1"});
  EXPECT_EQ(told().back(), 'V');
  supervisor.look();
  supervisor.stop();
  EXPECT_EQ(manager_.heard(), Messages{}) << "it is said once";
}

}  // namespace
}  // namespace ivo::firmware
