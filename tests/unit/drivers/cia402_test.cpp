#include <gtest/gtest.h>

#include <array>

#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/mode.hpp"
#include "drivers/cia402/statusword.hpp"
#include "drivers/sim/sim_power.hpp"

namespace ivo::drivers::cia402 {
namespace {

constexpr std::array<PowerState, 8> kStates{PowerState::kNotReadyToSwitchOn,  PowerState::kSwitchOnDisabled,
                                            PowerState::kReadyToSwitchOn,     PowerState::kSwitchedOn,
                                            PowerState::kOperationEnabled,    PowerState::kQuickStopActive,
                                            PowerState::kFaultReactionActive, PowerState::kFault};

/// The standard's table once more, bit by bit as it is printed there: x means any.
PowerState expected_state(unsigned word) {
  const bool b0 = word & 1, b1 = word & 2, b2 = word & 4, b3 = word & 8, b5 = word & 32, b6 = word & 64;
  const unsigned low = unsigned{b3} * 8 + unsigned{b2} * 4 + unsigned{b1} * 2 + unsigned{b0};
  if (b6) {
    return low == 0 ? PowerState::kSwitchOnDisabled : PowerState::kUnknown;
  }
  switch (low) {
    case 0b0000:
      return PowerState::kNotReadyToSwitchOn;
    case 0b0001:
      return b5 ? PowerState::kReadyToSwitchOn : PowerState::kUnknown;
    case 0b0011:
      return b5 ? PowerState::kSwitchedOn : PowerState::kUnknown;
    case 0b0111:
      return b5 ? PowerState::kOperationEnabled : PowerState::kQuickStopActive;
    case 0b1111:
      return PowerState::kFaultReactionActive;
    case 0b1000:
      return PowerState::kFault;
    default:
      return PowerState::kUnknown;
  }
}

TEST(Statusword, AllSixtyFiveThousandDecodeAsTheStandardHasIt) {
  for (unsigned word = 0; word <= 0xFFFF; ++word) {
    ASSERT_EQ(power_state(static_cast<std::uint16_t>(word)), expected_state(word)) << std::hex << word;
  }
}

TEST(Statusword, BitsOfEveryStateDecodeToIt) {
  for (const PowerState state : kStates) {
    EXPECT_EQ(power_state(statusword_bits(state)), state);
    EXPECT_EQ(power_state(statusword_bits(state) | 0xFE90), state);
  }
}

TEST(Controlword, FromEveryStateToEveryGoalIsTheWordOfTheStandard) {
  struct Row {
    PowerState now;
    std::array<int, 3> words;  // towards Ready, Switched On, Operation Enabled
  };
  constexpr std::array<Row, 9> kTable{{
      {PowerState::kNotReadyToSwitchOn, {0x00, 0x00, 0x00}},
      {PowerState::kSwitchOnDisabled, {0x06, 0x06, 0x06}},
      {PowerState::kReadyToSwitchOn, {0x06, 0x07, 0x07}},
      {PowerState::kSwitchedOn, {0x06, 0x07, 0x0F}},
      {PowerState::kOperationEnabled, {0x06, 0x07, 0x0F}},
      {PowerState::kQuickStopActive, {0x00, 0x00, 0x00}},
      {PowerState::kFaultReactionActive, {0x00, 0x00, 0x00}},
      {PowerState::kFault, {0x00, 0x00, 0x00}},
      {PowerState::kUnknown, {0x00, 0x00, 0x00}},
  }};
  for (const Row& row : kTable) {
    EXPECT_EQ(toward(row.now, PowerState::kReadyToSwitchOn), row.words[0]);
    EXPECT_EQ(toward(row.now, PowerState::kSwitchedOn), row.words[1]);
    EXPECT_EQ(toward(row.now, PowerState::kOperationEnabled), row.words[2]);
  }
}

TEST(Controlword, EnablesOperationFromSwitchedOnOnly) {
  for (const PowerState state : kStates) {
    for (const PowerState goal : {PowerState::kReadyToSwitchOn, PowerState::kSwitchedOn}) {
      EXPECT_NE(toward(state, goal), controlword::kEnableOperation);
    }
  }
}

TEST(SimulatedPower, WalksUpOneStateForEachWord) {
  SimPower power;
  for (const PowerState goal : {PowerState::kReadyToSwitchOn, PowerState::kSwitchedOn, PowerState::kOperationEnabled}) {
    power.command(toward(power.state(), goal));
    EXPECT_EQ(power.state(), goal);
  }
}

TEST(SimulatedPower, EnableOperationAloneDoesNotLeaveSwitchOnDisabled) {
  SimPower power;
  power.command(controlword::kEnableOperation);
  EXPECT_EQ(power.state(), PowerState::kSwitchOnDisabled);
}

TEST(SimulatedPower, LeavesFaultOnARisingEdgeOnly) {
  SimPower power;
  power.command(controlword::kFaultReset);
  power.fault();
  power.at_rest();
  ASSERT_EQ(power.state(), PowerState::kFault);
  power.command(controlword::kFaultReset);
  EXPECT_EQ(power.state(), PowerState::kFault) << "bit 7 was up before";
  power.command(controlword::kDisableVoltage);
  power.command(controlword::kFaultReset);
  EXPECT_EQ(power.state(), PowerState::kSwitchOnDisabled);
}

TEST(SimulatedPower, QuickStopEndsInSwitchOnDisabledAtRest) {
  SimPower power;
  power.command(controlword::kShutdown);
  power.command(controlword::kEnableOperation);
  power.command(controlword::kQuickStop);
  EXPECT_EQ(power.state(), PowerState::kQuickStopActive);
  power.command(controlword::kEnableOperation);
  EXPECT_EQ(power.state(), PowerState::kQuickStopActive);
  power.at_rest();
  EXPECT_EQ(power.state(), PowerState::kSwitchOnDisabled);
}

TEST(VelocityMode, PrefersCyclicSynchronousAndRefusesWhenThereIsNone) {
  EXPECT_EQ(velocity_mode(0x104), Mode::kCyclicSynchronousVelocity);
  EXPECT_EQ(velocity_mode(0x100), Mode::kCyclicSynchronousVelocity);
  EXPECT_EQ(velocity_mode(0x004), Mode::kProfileVelocity);
  EXPECT_EQ(velocity_mode(0xFFFFFEFB), std::nullopt);
  EXPECT_EQ(velocity_mode(0), std::nullopt);
}

}  // namespace
}  // namespace ivo::drivers::cia402
