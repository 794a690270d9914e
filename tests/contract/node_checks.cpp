// NMT, boot-up and heartbeats both ways (CiA 301, 7.2.8).
#include <array>
#include <chrono>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/cia402/objects.hpp"
#include "tests/contract/drive_contract.hpp"

namespace ivo::contract {
namespace {

using drivers::NmtCommand;
using drivers::NmtState;
using drivers::cia402::PowerState;
using std::chrono::milliseconds;
namespace object = drivers::object;

constexpr drivers::ObjectAddress kSecondConsumer{0x1016, 2};
constexpr drivers::ObjectAddress kErrorBehaviour{0x1029, 1};

void expect_boot_up(DriveBench& bench) {
  bench.expect("boot-up message", [&](const hal::CanFrame& frame) {
    return frame == drivers::heartbeat_frame(bench.node(), NmtState::kBootUp);
  });
}

void says_boot_up(DriveBench& bench) {
  for (const NmtCommand command : {NmtCommand::kResetNode, NmtCommand::kResetCommunication}) {
    for (const std::uint8_t node : {bench.node(), std::uint8_t{0}}) {
      bench.forget();
      bench.nmt(command, node);
      expect_boot_up(bench);
    }
  }
}

void begins_pre_operational(DriveBench& bench) {
  bench.watch_states();
  bench.expect_state(NmtState::kPreOperational);
}

void follows_nmt(DriveBench& bench) {
  bench.watch_states();
  const std::pair<NmtCommand, NmtState> orders[] = {{NmtCommand::kStart, NmtState::kOperational},
                                                    {NmtCommand::kStop, NmtState::kStopped},
                                                    {NmtCommand::kEnterPreOperational, NmtState::kPreOperational},
                                                    {NmtCommand::kStop, NmtState::kStopped},
                                                    {NmtCommand::kStart, NmtState::kOperational},
                                                    {NmtCommand::kEnterPreOperational, NmtState::kPreOperational}};
  for (const auto& [command, state] : orders) {
    bench.nmt(command);
    bench.expect_state(state);
  }
  bench.nmt(NmtCommand::kStart, 0);
  bench.expect_state(NmtState::kOperational);
}

void leaves_orders_to_others_alone(DriveBench& bench) {
  bench.watch_states();
  const std::uint8_t other = bench.node() == 1 ? 2 : 1;
  bench.forget();
  bench.nmt(NmtCommand::kStart, static_cast<std::uint8_t>(other + 100));
  bench.send({.id = 0, .size = 1, .data = {0x01}});
  bench.wait(milliseconds(200));
  require(!bench.heard([&](const hal::CanFrame& frame) {
    return frame == drivers::heartbeat_frame(bench.node(), NmtState::kOperational);
  }),
          "an NMT command that is not for it, or too short, is followed");
}

void keeps_quiet_when_stopped(DriveBench& bench) {
  bench.nmt(NmtCommand::kStop);
  bench.wait(milliseconds(20));
  const auto answer =
      bench.ask(drivers::sdo_frame(drivers::cob_id::sdo_request(bench.node()), {0x40, object::kDeviceType, 0}));
  require(!answer.has_value(), "SDO is answered in Stopped");
}

void forgets_communication_at_reset(DriveBench& bench) {
  const std::uint32_t before = bench.must_read(object::kConsumerHeartbeat);
  bench.must_write(object::kConsumerHeartbeat, 4, std::uint32_t{bench.master()} << 16 | 500);
  bench.must_write(object::kTargetVelocity, 4, 0);
  bench.forget();
  bench.nmt(NmtCommand::kResetCommunication);
  expect_boot_up(bench);
  require(bench.must_read(object::kConsumerHeartbeat) == before, "1016h:1 is kept over a reset of communication");
}

void watches_each_node_once(DriveBench& bench) {
  if (!bench.has(kSecondConsumer)) {
    throw NotThere("1016h:2 is not there");
  }
  const std::uint32_t entry = std::uint32_t{bench.master()} << 16;
  bench.must_write(object::kConsumerHeartbeat, 4, entry | 500);
  bench.must_refuse(kSecondConsumer, 4, entry | 700, 0x06040043);
  bench.must_write(kSecondConsumer, 4, 0);
  bench.must_write(object::kConsumerHeartbeat, 4, entry | 700);
}

void watches_from_the_first_heartbeat(DriveBench& bench) {
  bench.must_write(object::kConsumerHeartbeat, 4, std::uint32_t{bench.master()} << 16 | 50);
  bench.watch_states();
  bench.nmt(NmtCommand::kStart);
  bench.expect_state(NmtState::kOperational);
  bench.forget();
  bench.wait(milliseconds(300));
  require(!bench.heard([&](const hal::CanFrame& frame) { return frame.id == drivers::cob_id::emcy(bench.node()); }),
          "a master that never spoke is missed");
}

void stops_when_its_master_falls_silent(DriveBench& bench) {
  if (bench.write(kErrorBehaviour, 1, 1).abort == 0x06010002) {
    throw NotThere("1029h:1 cannot be written");
  }
  bench.must_write(object::kAbortConnectionOption, 2, 3);
  bench.bring_to(PowerState::kOperationEnabled);
  bench.turn();
  bench.forget();
  bench.beat(false);
  bench.expect("emergency 8130h", [&](const hal::CanFrame& frame) {
    return frame.id == drivers::cob_id::emcy(bench.node()) && frame.data[0] == 0x30 && frame.data[1] == 0x81;
  });
  bench.expect_rest("without its master's heartbeat");
  require(bench.power() != PowerState::kOperationEnabled, "without its master's heartbeat it stays enabled");
  bench.beat(true);
  bench.wait(milliseconds(100));
  require(bench.power() != PowerState::kOperationEnabled, "it is enabled again by a heartbeat alone");
}

void leaves_operational_without_its_master(DriveBench& bench) {
  if (!bench.has(kErrorBehaviour)) {
    throw NotThere("1029h:1 is not there");
  }
  const std::pair<std::uint32_t, NmtState> behaviours[] = {{0, NmtState::kPreOperational}, {2, NmtState::kStopped}};
  for (const auto& [behaviour, state] : behaviours) {
    bench.reset();
    bench.must_write(kErrorBehaviour, 1, behaviour);
    bench.bring_to(PowerState::kSwitchOnDisabled);
    bench.wait(milliseconds(50));
    bench.beat(false);
    bench.expect_state(state);
  }
}

const std::array kChecks = {
    Check{"SaysBootUpAfterEachReset", false, says_boot_up},
    Check{"BeginsPreOperational", false, begins_pre_operational},
    Check{"FollowsNmtCommands", false, follows_nmt},
    Check{"LeavesOrdersToOthersAlone", false, leaves_orders_to_others_alone},
    Check{"DoesNotAnswerSdoWhenStopped", false, keeps_quiet_when_stopped},
    Check{"ForgetsCommunicationObjectsAtReset", false, forgets_communication_at_reset},
    Check{"WatchesEachNodeOnce", false, watches_each_node_once},
    Check{"WatchesItsMasterFromTheFirstHeartbeat", false, watches_from_the_first_heartbeat},
    Check{"StopsWhenItsMasterFallsSilent", true, stops_when_its_master_falls_silent},
    Check{"LeavesOperationalWithoutItsMaster", false, leaves_operational_without_its_master},
};

}  // namespace

std::span<const Check> node_checks() { return kChecks; }

}  // namespace ivo::contract
