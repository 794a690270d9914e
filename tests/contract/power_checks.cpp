// The power state machine and the motor (CiA 402-2, 6 and 16).
#include <array>
#include <chrono>
#include <string>

#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/mode.hpp"
#include "drivers/cia402/objects.hpp"
#include "tests/contract/drive_contract.hpp"

namespace ivo::contract {
namespace {

using drivers::NmtCommand;
using drivers::NmtState;
using drivers::cia402::PowerState;
using std::chrono::milliseconds;
namespace object = drivers::object;
namespace controlword = drivers::cia402::controlword;

constexpr std::uint16_t kHalt = 0x100;
constexpr std::uint16_t kVoltage = 0x10;
constexpr std::uint16_t kRemote = 0x200;

struct Transition {
  PowerState from;
  std::uint16_t word;
  PowerState to;
};

// Every state that a master can bring a drive to, with every command. 0Fh from Ready to Switch On is not among them: a
// drive may take two transitions or one.
constexpr PowerState kDisabled = PowerState::kSwitchOnDisabled;
constexpr PowerState kReady = PowerState::kReadyToSwitchOn;
constexpr PowerState kOn = PowerState::kSwitchedOn;
constexpr PowerState kEnabled = PowerState::kOperationEnabled;
constexpr PowerState kFault = PowerState::kFault;
constexpr Transition kTransitions[] = {
    {kDisabled, 0x00, kDisabled}, {kDisabled, 0x02, kDisabled}, {kDisabled, 0x06, kReady},
    {kDisabled, 0x07, kDisabled}, {kDisabled, 0x0F, kDisabled}, {kDisabled, 0x80, kDisabled},
    {kReady, 0x00, kDisabled},    {kReady, 0x02, kDisabled},    {kReady, 0x06, kReady},
    {kReady, 0x07, kOn},          {kReady, 0x80, kDisabled},    {kOn, 0x00, kDisabled},
    {kOn, 0x02, kDisabled},       {kOn, 0x06, kReady},          {kOn, 0x07, kOn},
    {kOn, 0x0F, kEnabled},        {kOn, 0x80, kDisabled},       {kEnabled, 0x00, kDisabled},
    {kEnabled, 0x02, kDisabled},  {kEnabled, 0x06, kReady},     {kEnabled, 0x07, kOn},
    {kEnabled, 0x0F, kEnabled},   {kEnabled, 0x80, kDisabled},  {kFault, 0x00, kFault},
    {kFault, 0x02, kFault},       {kFault, 0x06, kFault},       {kFault, 0x07, kFault},
    {kFault, 0x0F, kFault},       {kFault, 0x80, kDisabled},
};

void walks_the_state_machine(DriveBench& bench) {
  for (const Transition& transition : kTransitions) {
    bench.reset();
    if (transition.from == kFault) {
      bench.bring_to_fault();
    } else {
      bench.bring_to(transition.from);
    }
    const std::string when = "from the state of " + hexadecimal(drivers::cia402::statusword_bits(transition.from), 4) +
                             " after " + hexadecimal(transition.word, 4);
    bench.control(transition.word);
    bench.expect_power(transition.to, when);
    bench.wait(milliseconds(20));
    require(bench.power() == transition.to, when + " it does not stay where it went");
  }
}

void resets_a_fault_by_an_edge(DriveBench& bench) {
  bench.bring_to_fault();
  bench.control(controlword::kFaultReset);
  bench.expect_power(kDisabled, "after a rising edge of bit 7");
  bench.reset();
  bench.control(controlword::kFaultReset);  // the bit is up before the fault
  bench.bring_to_fault();
  bench.control(controlword::kFaultReset);
  bench.wait(milliseconds(50));
  require(bench.power() == kFault, "a fault is reset by bit 7 without an edge");
  bench.control(controlword::kDisableVoltage);
  bench.control(controlword::kFaultReset);
  bench.expect_power(kDisabled, "after a rising edge of bit 7");
}

void shows_the_mode(DriveBench& bench) {
  const std::uint32_t modes = bench.must_read(object::kSupportedModes);
  for (std::uint32_t mode = 1; mode <= 32; ++mode) {
    const Reply reply = bench.write(object::kModeOfOperation, 1, mode);
    require(((modes >> (mode - 1) & 1) != 0) == (reply.abort == 0), "6502h is " + hexadecimal(modes, 8) + " and mode " +
                                                                        std::to_string(mode) + " is " +
                                                                        (reply.abort == 0 ? "taken" : "refused"));
  }
  const auto mode = drivers::cia402::velocity_mode(modes);
  require(mode.has_value(), "6502h offers no velocity mode");
  bench.must_write(object::kModeOfOperation, 1, static_cast<std::uint8_t>(*mode));
  bench.wait(milliseconds(50));
  require(bench.must_read(object::kModeDisplay) == static_cast<std::uint8_t>(*mode), "6061h does not follow 6060h");
}

void says_that_voltage_is_there(DriveBench& bench) {
  bench.bring_to(kDisabled);
  const std::uint16_t word = bench.statusword();
  require((word & kVoltage) != 0, "bit 4 of the statusword says no voltage");
  require((word & kRemote) != 0, "bit 9 of the statusword says that nobody listens");
}

void stands_when_enabled(DriveBench& bench) {
  bench.bring_to(kEnabled);
  bench.wait(milliseconds(200));
  require(std::abs(bench.velocity()) <= std::abs(bench.speed()) / 20, "with target 0 the wheel turns");
}

void turns_as_told(DriveBench& bench) {
  bench.bring_to(kEnabled);
  const auto before = bench.must_read(object::kPositionActual);
  bench.turn();
  bench.wait(milliseconds(200));
  const auto moved = static_cast<std::int32_t>(bench.must_read(object::kPositionActual) - before);
  require(moved != 0 && (moved > 0) == (bench.speed() > 0), "6064h does not go the way that 60FFh says");
  bench.must_write(object::kTargetVelocity, 4, 0);
  bench.expect_rest("with target 0");
  require(bench.power() == kEnabled, "with target 0 it is not enabled any more");
}

void quick_stop_ends_disabled(DriveBench& bench) {
  bench.must_write(object::kQuickStopOption, 2, 2);
  bench.bring_to(kEnabled);
  bench.turn();
  bench.control(controlword::kQuickStop);
  require(bench.power() != kEnabled, "after a quick stop it is still enabled");
  bench.expect_rest("after a quick stop");
  bench.expect_power(kDisabled, "after a quick stop");
}

void quick_stop_may_stay(DriveBench& bench) {
  if (bench.write(object::kQuickStopOption, 2, 6).abort != 0) {
    throw NotThere("605Ah 6 is not there");
  }
  bench.bring_to(kEnabled);
  bench.turn();
  bench.control(controlword::kQuickStop);
  bench.expect_rest("after a quick stop");
  bench.expect_power(PowerState::kQuickStopActive, "with 605Ah 6 after a quick stop");
  bench.control(controlword::kDisableVoltage);
  bench.expect_power(kDisabled, "after disable voltage");
}

void halt_rests_enabled(DriveBench& bench) {
  bench.bring_to(kEnabled);
  bench.turn();
  bench.control(controlword::kEnableOperation | kHalt);
  bench.expect_rest("with the halt bit");
  require(bench.power() == kEnabled, "with the halt bit it is not enabled any more");
  bench.control(controlword::kEnableOperation);
  bench.turn();
}

void every_way_down_ends_at_rest(DriveBench& bench) {
  const std::pair<std::uint16_t, PowerState> ways[] = {
      {controlword::kDisableVoltage, kDisabled}, {controlword::kShutdown, kReady}, {controlword::kSwitchOn, kOn}};
  for (const auto& [word, state] : ways) {
    bench.reset();
    bench.bring_to(kEnabled);
    bench.turn();
    bench.control(word);
    bench.expect_power(state, "after " + hexadecimal(word, 4));
    bench.expect_rest("after " + hexadecimal(word, 4));
  }
}

void stops_when_it_leaves_operational(DriveBench& bench) {
  bench.must_write(object::kAbortConnectionOption, 2, 3);
  bench.bring_to(kEnabled);
  bench.turn();
  bench.nmt(NmtCommand::kEnterPreOperational);
  bench.expect_state(NmtState::kPreOperational);
  bench.expect_rest("in Pre-operational");
  require(bench.power() != kEnabled, "in Pre-operational it is still enabled");
  bench.nmt(NmtCommand::kStart);
  bench.expect_state(NmtState::kOperational);
  bench.wait(milliseconds(100));
  require(bench.power() != kEnabled, "it is enabled again by NMT start alone");
}

void is_off_after_a_reset(DriveBench& bench) {
  bench.bring_to(kEnabled);
  bench.turn();
  bench.reset();
  require(bench.power() == kDisabled, "after a reset it is not in Switch On Disabled");
  bench.expect_rest("after a reset");
  require(bench.must_read(object::kTargetVelocity) == 0, "60FFh is kept over a reset of the node");
}

const std::array kChecks = {
    Check{"WalksTheStateMachine", false, walks_the_state_machine},
    Check{"ResetsAFaultByARisingEdge", false, resets_a_fault_by_an_edge},
    Check{"ShowsTheModeThatItTook", false, shows_the_mode},
    Check{"SaysThatVoltageIsThere", false, says_that_voltage_is_there},
    Check{"StandsWhenEnabledWithTargetZero", false, stands_when_enabled},
    Check{"TurnsAsTold", true, turns_as_told},
    Check{"QuickStopEndsInSwitchOnDisabled", true, quick_stop_ends_disabled},
    Check{"QuickStopMayStayActive", true, quick_stop_may_stay},
    Check{"HaltRestsEnabled", true, halt_rests_enabled},
    Check{"EveryWayDownEndsAtRest", true, every_way_down_ends_at_rest},
    Check{"StopsWhenItLeavesOperational", true, stops_when_it_leaves_operational},
    Check{"IsOffAfterAReset", true, is_off_after_a_reset},
};

}  // namespace

std::span<const Check> power_checks() { return kChecks; }

}  // namespace ivo::contract
