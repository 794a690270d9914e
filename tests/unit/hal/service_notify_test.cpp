#include "hal/linux/service_notify.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/listening_manager.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ivo::hal {
namespace {

using std::chrono::microseconds;
using Messages = std::vector<std::string>;

class ServiceNotifyTest : public testing::Test {
 protected:
  ServiceNotifyTest() { ListeningManager::forget(); }
  ~ServiceNotifyTest() override { ListeningManager::forget(); }

  static ServiceNotify opened() {
    Result<ServiceNotify> notify = ServiceNotify::open();
    EXPECT_TRUE(notify) << notify.error().message;
    return std::move(notify).value();
  }
  [[nodiscard]] std::string path() const { return folder_.path("notify"); }

  ScratchFolder folder_;
};

TEST_F(ServiceNotifyTest, SpeaksInTheManagersWordsToAPath) {
  ListeningManager manager(path());
  ServiceNotify notify = opened();
  notify.ready();
  notify.status("planning, generation 3");
  notify.alive();
  notify.stopping();
  EXPECT_EQ(manager.heard(), (Messages{"READY=1", "STATUS=planning, generation 3", "WATCHDOG=1", "STOPPING=1"}));
  EXPECT_EQ(notify.lost(), 0U);
}

TEST_F(ServiceNotifyTest, SpeaksToAnAbstractSocket) {
  ListeningManager manager(ListeningManager::some_name());
  ServiceNotify notify = opened();
  EXPECT_TRUE(notify.listened_to());
  notify.ready();
  EXPECT_EQ(manager.heard(), Messages{"READY=1"});
}

TEST_F(ServiceNotifyTest, SaysNothingWithoutAManager) {
  ServiceNotify notify = opened();
  EXPECT_FALSE(notify.listened_to());
  EXPECT_EQ(notify.timeout(), std::nullopt);
  notify.ready();
  notify.status("alone");
  EXPECT_EQ(notify.lost(), 0U);
}

TEST_F(ServiceNotifyTest, IsNotWatchedWithoutAManagerWhateverTheTimeout) {
  ListeningManager::watch("1000000");
  EXPECT_EQ(opened().timeout(), std::nullopt);
}

TEST_F(ServiceNotifyTest, TakesTheVariablesOutOfTheEnvironment) {
  const ListeningManager manager(path());
  ListeningManager::watch("1000000", std::to_string(getpid()));
  EXPECT_EQ(opened().timeout(), microseconds(1'000'000));
  for (const char* const name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) {
    EXPECT_EQ(getenv(name), nullptr) << name;
  }
}

TEST_F(ServiceNotifyTest, IsNotWatchedWhereAnotherProcessIsMeant) {
  const ListeningManager manager(path());
  ListeningManager::watch("1000000", std::to_string(getpid() + 1));
  const ServiceNotify notify = opened();
  EXPECT_TRUE(notify.listened_to());
  EXPECT_EQ(notify.timeout(), std::nullopt);
}

TEST_F(ServiceNotifyTest, IsNotWatchedByATimeoutOfNothing) {
  const ListeningManager manager(path());
  ListeningManager::watch("0");
  EXPECT_EQ(opened().timeout(), std::nullopt);
}

TEST_F(ServiceNotifyTest, AStatusIsOneLineAndNoOtherAssignment) {
  ListeningManager manager(path());
  opened().status("front\nREADY=1\r\nrear");
  EXPECT_EQ(manager.heard(), Messages{"STATUS=front READY=1  rear"});
}

TEST_F(ServiceNotifyTest, FindsAManagerThatStartsAnew) {
  ServiceNotify notify;
  {
    const ListeningManager manager(path());
    notify = opened();
  }
  notify.alive();
  EXPECT_EQ(notify.lost(), 1U);
  ListeningManager again(path());
  notify.alive();
  EXPECT_EQ(notify.lost(), 1U);
  EXPECT_EQ(again.heard(), Messages{"WATCHDOG=1"});
}

TEST_F(ServiceNotifyTest, NeverWaitsForAManagerThatDoesNotRead) {
  const ListeningManager manager(path());
  ServiceNotify notify = opened();
  for (int i = 0; i < 10'000; ++i) {
    notify.alive();
  }
  EXPECT_GT(notify.lost(), 0U);
}

TEST_F(ServiceNotifyTest, RefusesASocketThatIsNone) {
  for (const std::string& name :
       {std::string("vsock:2:1"), std::string("@"), std::string(), "/" + std::string(200, 'x')}) {
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
    const Result<ServiceNotify> notify = ServiceNotify::open();
    ASSERT_FALSE(notify) << name;
    EXPECT_EQ(notify.error().message,
              "NOTIFY_SOCKET is \"" + name + "\"; expected the path of a socket, or @ and an abstract one's name");
  }
}

TEST_F(ServiceNotifyTest, RefusesNumbersThatAreNone) {
  for (const auto& [usec, pid, wrong] :
       std::vector<std::array<std::string, 3>>{{"1s", "1", "WATCHDOG_USEC is \"1s\""},
                                               {"1000", "-1", "WATCHDOG_PID is \"-1\""},
                                               {"", "1", "WATCHDOG_USEC is \"\""}}) {
    const ListeningManager manager(path());
    ListeningManager::watch(usec, pid == "1" ? std::to_string(getpid()) : pid);
    const Result<ServiceNotify> notify = ServiceNotify::open();
    ASSERT_FALSE(notify) << wrong;
    EXPECT_EQ(notify.error().message, wrong + "; expected a whole number, as the service manager sets it");
  }
}

}  // namespace
}  // namespace ivo::hal
