// What every DigitalInputs promises (hal/api/digital_io.hpp), asked of each one that there is.
#include <gtest/gtest.h>

#include "hal/linux/gpio_inputs.hpp"
#include "hal/sim/digital_inputs.hpp"
#include "tests/unit/hal/scripted_lines.hpp"

namespace ivo::hal {
namespace {

using std::chrono::milliseconds;

struct Simulated {
  SimDigitalInputs inputs;
  Instant now{std::chrono::seconds(1)};
  void press(std::size_t input) { inputs.press(input); }
  void release(std::size_t input) { inputs.release(input); }
  void tap(std::size_t input) { inputs.tap(input); }
  void fall_silent() { inputs.fall_silent(now); }
  void resume() { inputs.resume(); }
  void pass(Duration time) { now += time; }
  DigitalSnapshot look() { return inputs.snapshot(now); }
};

struct OnLines {
  LineScript script;
  SharedClock clock;
  GpioInputs inputs{std::make_unique<ScriptedLines>(script), clock};
  std::uint8_t pressed = 0;
  OnLines() { script.await_reading(); }
  void press(std::size_t input) { script.set(pressed = static_cast<std::uint8_t>(pressed | 1U << input)); }
  void release(std::size_t input) { script.set(pressed = static_cast<std::uint8_t>(pressed & ~(1U << input))); }
  void tap(std::size_t input) { script.tap(static_cast<std::uint8_t>(1U << input)); }
  void fall_silent() { script.hang(); }
  void resume() { script.go_on(); }
  void pass(Duration time) { clock.sleep_until(clock.now() + time); }
  DigitalSnapshot look() { return inputs.snapshot(clock.now()); }
  ~OnLines() { script.go_on(); }
};

template <class Machine>
class DigitalInputsContract : public testing::Test {
 protected:
  Machine machine_;
};
using Machines = testing::Types<Simulated, OnLines>;
TYPED_TEST_SUITE(DigitalInputsContract, Machines);

TYPED_TEST(DigitalInputsContract, SaysWhatIsPressed) {
  auto& machine = this->machine_;
  EXPECT_TRUE(machine.look().valid);
  EXPECT_EQ(machine.look().pressed, 0);
  for (std::size_t input = 0; input < kDigitalInputs; ++input) {
    machine.press(input);
    EXPECT_EQ(machine.look().pressed, 1U << input);
    machine.release(input);
    EXPECT_EQ(machine.look().pressed, 0);
  }
  machine.press(0);
  machine.press(7);
  EXPECT_EQ(machine.look().pressed, 0x81);
}

TYPED_TEST(DigitalInputsContract, ShowsAShortPressOnce) {
  auto& machine = this->machine_;
  machine.tap(3);
  machine.tap(5);
  EXPECT_EQ(machine.look().pressed, 0b101000);
  EXPECT_EQ(machine.look().pressed, 0);
}

TYPED_TEST(DigitalInputsContract, SaysHowOldItsReadingIs) {
  auto& machine = this->machine_;
  machine.press(1);
  machine.fall_silent();
  machine.pass(milliseconds(49));
  EXPECT_EQ(machine.look().age, milliseconds(49));
  EXPECT_EQ(machine.look().pressed, 0b10) << "the last that is known";
  machine.pass(milliseconds(1000));
  EXPECT_EQ(machine.look().age, milliseconds(1049));
  machine.resume();
  EXPECT_EQ(machine.look().age, Duration::zero());
}

}  // namespace
}  // namespace ivo::hal
