#include "firmware/safety/stop_inputs.hpp"

#include <gtest/gtest.h>

#include "config/rates.hpp"
#include "drivers/drive_fault_text.hpp"
#include "hal/sim/digital_inputs.hpp"

namespace ivo::firmware {
namespace {

using drivers::DriveFaultReason;
using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""ns;

InputParameters fitted(bool emergency_stop, int bumpers) {
  InputParameters inputs;
  inputs.chip = "gpiochip0";
  if (emergency_stop) {
    inputs.emergency_stop = InputLine{};
  }
  for (int i = 0; i < bumpers; ++i) {
    inputs.bumpers[static_cast<std::size_t>(i)] = InputLine{};
  }
  return inputs;
}

hal::DigitalSnapshot fresh(unsigned pressed) {
  return {.pressed = static_cast<std::uint8_t>(pressed), .age = Duration::zero(), .valid = true};
}

TEST(StopInputs, StopByTheNumberOfWhatIsPressed) {
  const StopInputs inputs(fitted(true, 7));
  EXPECT_FALSE(inputs.judge(fresh(0)));
  for (unsigned input = 0; input < hal::kDigitalInputs; ++input) {
    const auto fault = inputs.judge(fresh(1U << input));
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->reason, DriveFaultReason::kStopInput);
    EXPECT_EQ(fault->code, input);
    EXPECT_EQ(fault->node_id, 0);
  }
  EXPECT_EQ(describe(*inputs.judge(fresh(1))), "emergency stop pressed");
  EXPECT_EQ(describe(*inputs.judge(fresh(0b100))), "bumper 2 touched");
}

TEST(StopInputs, NameTheEmergencyStopBeforeAnyBumper) {
  const StopInputs inputs(fitted(true, 7));
  for (unsigned pressed = 1; pressed < 256; ++pressed) {
    const auto fault = inputs.judge(fresh(pressed));
    ASSERT_TRUE(fault);
    EXPECT_EQ(1U << fault->code, pressed & -pressed);
  }
}

TEST(StopInputs, TakeNoReadingForPressed) {
  const StopInputs inputs(fitted(true, 2));
  const auto unread = inputs.judge({});
  ASSERT_TRUE(unread);
  EXPECT_EQ(unread->code, drivers::kStopInputsSilent);
  EXPECT_EQ(describe(*unread), "emergency stop and bumpers are not read any more, which counts as pressed");
}

TEST(StopInputs, TakeAnOldReadingForPressed) {
  const StopInputs inputs(fitted(true, 2));
  hal::DigitalSnapshot snapshot = fresh(0);
  snapshot.age = rates::kInputsAge;
  EXPECT_FALSE(inputs.judge(snapshot));
  for (const Duration age : {rates::kInputsAge + 1ns, Duration::max(), Duration(-1ns)}) {
    snapshot.age = age;
    ASSERT_TRUE(inputs.judge(snapshot));
    EXPECT_EQ(inputs.judge(snapshot)->code, drivers::kStopInputsSilent);
  }
  snapshot.pressed = 1;
  EXPECT_EQ(inputs.judge(snapshot)->code, 0U) << "what was last known to be pressed is named";
}

TEST(StopInputs, LookAtNothingThatIsNotFitted) {
  const StopInputs none{InputParameters{}};
  EXPECT_FALSE(none.fitted());
  EXPECT_FALSE(none.judge({}));
  EXPECT_FALSE(none.judge(fresh(0xFF)));
  const StopInputs bumpers(fitted(false, 2));
  EXPECT_FALSE(bumpers.judge(fresh(0b11111001)));
  EXPECT_EQ(bumpers.judge(fresh(0b11111101))->code, 2U);
  EXPECT_TRUE(bumpers.judge({}));
}

TEST(StopInputs, SayNothingWhenReleased) {
  const StopInputs stop(fitted(true, 1));
  hal::SimDigitalInputs inputs;
  const Instant now(10ms);
  inputs.press(0);
  EXPECT_TRUE(stop.judge(inputs.snapshot(now)));
  EXPECT_TRUE(stop.judge(inputs.snapshot(now))) << "for as long as it is pressed";
  inputs.release(0);
  EXPECT_FALSE(stop.judge(inputs.snapshot(now)));
  inputs.tap(1);
  EXPECT_EQ(stop.judge(inputs.snapshot(now))->code, 1U);
  EXPECT_FALSE(stop.judge(inputs.snapshot(now)));
}

}  // namespace
}  // namespace ivo::firmware
