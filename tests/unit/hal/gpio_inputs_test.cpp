#include "hal/linux/gpio_inputs.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>

#include "hal/linux/monotonic_clock.hpp"
#include "tests/unit/hal/scripted_lines.hpp"

namespace ivo::hal {
namespace {

using std::chrono::milliseconds;

TEST(GpioInputs, HaveNothingToSayBeforeTheFirstReading) {
  LineScript script;
  SharedClock clock;
  script.make_unreadable_before_the_first();
  GpioInputs inputs(std::make_unique<ScriptedLines>(script), clock);
  script.await_reading();
  const DigitalSnapshot first = inputs.snapshot(clock.now());
  EXPECT_FALSE(first.valid);
  EXPECT_EQ(first.pressed, 0xFF);
  script.make_unreadable(false);
  EXPECT_TRUE(inputs.snapshot(clock.now()).valid);
}

TEST(GpioInputs, AgeWhileALineCannotBeRead) {
  LineScript script;
  SharedClock clock;
  GpioInputs inputs(std::make_unique<ScriptedLines>(script), clock);
  script.await_reading();
  script.make_unreadable(true);
  clock.sleep_until(clock.now() + milliseconds(60));
  script.await_reading();
  EXPECT_EQ(inputs.snapshot(clock.now()).age, milliseconds(60));
  EXPECT_GE(inputs.unreadable(), 1U);
  script.make_unreadable(false);
  EXPECT_EQ(inputs.snapshot(clock.now()).age, Duration::zero());
}

TEST(GpioInputs, AreNeverYoungerThanNothing) {
  LineScript script;
  SharedClock clock;
  GpioInputs inputs(std::make_unique<ScriptedLines>(script), clock);
  script.await_reading();
  EXPECT_EQ(inputs.snapshot(clock.now() - milliseconds(5)).age, Duration::zero()) << "read after the cycle began";
}

TEST(GpioInputs, EndTheirThreadWhenTheyEnd) {
  LineScript script;
  for (int i = 0; i < 50; ++i) {
    MonotonicClock clock;
    const GpioInputs inputs(std::make_unique<ScriptedLines>(script), clock);
  }
  SUCCEED() << "none is left that would use what is gone: the sanitizers see to it";
}

TEST(GpioInputs, LeaveSignalsToTheMainThread) {
  sigset_t before{};
  pthread_sigmask(SIG_SETMASK, nullptr, &before);
  LineScript script;
  SharedClock clock;
  const GpioInputs inputs(std::make_unique<ScriptedLines>(script), clock);
  script.await_reading();
  EXPECT_TRUE(script.reader_blocks(SIGINT) && script.reader_blocks(SIGTERM));
  sigset_t after{};
  pthread_sigmask(SIG_SETMASK, nullptr, &after);
  EXPECT_EQ(sigismember(&after, SIGINT), sigismember(&before, SIGINT));
}

}  // namespace
}  // namespace ivo::hal
