// Every cycle of every test of this program runs within ControlLoop::cycle, which is marked IVO_REALTIME: in the preset
// rtsan one that allocates, locks or waits ends the program. That it would is shown here.
#include "config/base/realtime.hpp"

#include <gtest/gtest.h>

#ifdef IVO_RTSAN

#include <chrono>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <type_traits>

#include "firmware/loop/control_loop.hpp"

namespace ivo::firmware {
namespace {

template <typename T>
struct Marked : std::false_type {};
template <typename Object, typename Return, typename... Arguments>
struct Marked<Return (Object::*)(Arguments...) noexcept IVO_REALTIME> : std::true_type {};

static_assert(Marked<decltype(&ControlLoop::cycle)>::value, "a cycle that is not marked is not looked at");
static_assert(!Marked<decltype(&ControlLoop::open)>::value);

void* volatile kept = nullptr;  // where a compiler cannot see that it is not used
std::mutex mutex;

void allocate() { kept = std::malloc(1); }
void give_back() { std::free(kept); }
void lock() { const std::lock_guard guard(mutex); }
void wait() { std::this_thread::sleep_for(std::chrono::microseconds(1)); }

template <auto kCall>
void in_a_cycle() noexcept IVO_REALTIME {
  kCall();
}
template <auto kCall>
void exempt_in_a_cycle() noexcept IVO_REALTIME {
  const KnownNotToWait exempt;
  kCall();
}

TEST(RealtimeDeathTest, WhoAllocatesLocksOrWaitsInACycleEndsTheProgramByName) {
  EXPECT_DEATH(in_a_cycle<allocate>(), "RealtimeSanitizer.*\n.*`malloc` in real-time context");
  allocate();
  EXPECT_DEATH(in_a_cycle<give_back>(), "`free` in real-time context");
  EXPECT_DEATH(in_a_cycle<lock>(), "`pthread_mutex_lock` in real-time context");
  EXPECT_DEATH(in_a_cycle<wait>(), "sleep` in real-time context");
}

TEST(Realtime, WhatIsExemptByNameIsNotRefused) {
  exempt_in_a_cycle<allocate>();
  exempt_in_a_cycle<lock>();
}

}  // namespace
}  // namespace ivo::firmware

#endif
