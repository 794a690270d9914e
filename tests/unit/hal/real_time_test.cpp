#include "hal/linux/real_time.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>

#include <array>
#include <csignal>
#include <string>
#include <thread>

namespace ivo::hal {
namespace {

TEST(RealTime, ACpuThatIsNotThereIsRefusedByName) {
  const Result<void> entered = may_enter_real_time({.priority = 80, .cpu = 1000});
  ASSERT_FALSE(entered);
  EXPECT_NE(entered.error().message.find("CPU 1000"), std::string::npos) << entered.error().message;
}

TEST(RealTime, PinsTheCallingThreadAndNoOther) {
  cpu_set_t before;
  ASSERT_EQ(pthread_getaffinity_np(pthread_self(), sizeof before, &before), 0);
  int last = CPU_SETSIZE - 1;
  while (!CPU_ISSET(static_cast<std::size_t>(last), &before)) {
    --last;
  }
  std::thread([last] {
    (void)enter_real_time({.priority = 80, .cpu = last});  // pinned also where the priority is not granted
    cpu_set_t pinned;
    ASSERT_EQ(pthread_getaffinity_np(pthread_self(), sizeof pinned, &pinned), 0);
    EXPECT_EQ(CPU_COUNT(&pinned), 1);
    EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(last), &pinned));
  }).join();
  cpu_set_t after;
  ASSERT_EQ(pthread_getaffinity_np(pthread_self(), sizeof after, &after), 0);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

TEST(RealTime, TryingLeavesTheCallersSchedulingAsItWas) {
  const int before = sched_getscheduler(0);
  (void)may_enter_real_time({});
  EXPECT_EQ(sched_getscheduler(0), before);
}

TEST(RealTime, AThreadHasItsNameAndLeavesSignalsToOthers) {
  std::thread([] {
    name_thread("ivo-loop");
    std::array<char, 16> name{};
    ASSERT_EQ(pthread_getname_np(pthread_self(), name.data(), name.size()), 0);
    EXPECT_STREQ(name.data(), "ivo-loop");
    leave_signals_to_others();
    sigset_t blocked;
    ASSERT_EQ(pthread_sigmask(SIG_BLOCK, nullptr, &blocked), 0);
    EXPECT_EQ(sigismember(&blocked, SIGTERM), 1);
    EXPECT_EQ(sigismember(&blocked, SIGINT), 1);
  }).join();
}

TEST(RealTime, APageFaultOfTheCallingThreadIsCounted) {
  constexpr std::size_t kBytes = std::size_t{64} << 12U;
  const PageFaults before = page_faults();
  void* const memory = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  static_cast<volatile char*>(memory)[kBytes / 2] = 1;
  EXPECT_GT(page_faults().minor, before.minor);
  (void)munmap(memory, kBytes);
}

}  // namespace
}  // namespace ivo::hal
