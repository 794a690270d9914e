// Process data: mapping and its rules, transmission types, SYNC (CiA 301, 7.2.2 and 7.5.2.34 to 7.5.2.38).
#include <array>
#include <bit>
#include <chrono>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/little_endian.hpp"
#include "drivers/canopen/sync.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/objects.hpp"
#include "tests/contract/drive_contract.hpp"

namespace ivo::contract {
namespace {

using drivers::NmtCommand;
using drivers::NmtState;
using drivers::ObjectAddress;
using drivers::cia402::PowerState;
using std::chrono::milliseconds;
namespace object = drivers::object;
namespace controlword = drivers::cia402::controlword;

constexpr std::uint32_t kInvalid = drivers::cob_id::kPdoInvalid;
constexpr std::uint32_t kReadOnly = 0x06010002;
constexpr std::uint32_t kDummy = 0x00070020;

std::uint32_t rpdo1(const DriveBench& bench) { return drivers::cob_id::rpdo1(bench.node()); }
std::uint32_t tpdo1(const DriveBench& bench) { return drivers::cob_id::tpdo1(bench.node()); }
std::uint32_t map_controlword() { return object::mapped(object::kControlword, 16); }
std::uint32_t map_target() { return object::mapped(object::kTargetVelocity, 32); }
std::uint32_t map_statusword() { return object::mapped(object::kStatusword, 16); }
std::uint32_t map_position() { return object::mapped(object::kPositionActual, 32); }

struct Pdo {
  ObjectAddress cob_id_object;
  ObjectAddress count;
  std::uint32_t cob_id = 0;
  std::uint8_t type = 1;
};

/// NotThere where the mapping cannot be written at all.
void map(DriveBench& bench, const Pdo& pdo, const std::vector<std::uint32_t>& entries) {
  const Reply disabled = bench.write(pdo.cob_id_object, 4, pdo.cob_id | kInvalid);
  if (disabled.abort == kReadOnly || bench.write(pdo.count, 1, 0).abort == kReadOnly) {
    throw NotThere("PDO mappings cannot be written");
  }
  bench.must_write(pdo.count, 1, 0);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    bench.must_write({pdo.count.index, static_cast<std::uint8_t>(i + 1)}, 4, entries[i]);
  }
  bench.must_write(pdo.count, 1, static_cast<std::uint32_t>(entries.size()));
  require(bench.must_read(pdo.count) == entries.size(), "the count of a mapping reads back otherwise");
  bench.must_write({pdo.cob_id_object.index, 2}, 1, pdo.type);
  bench.must_write(pdo.cob_id_object, 4, pdo.cob_id);
}

Pdo command_pdo(const DriveBench& bench, std::uint8_t type = 1) {
  return {object::kRpdo1CobId, object::kRpdo1Count, rpdo1(bench), type};
}
Pdo feedback_pdo(const DriveBench& bench, std::uint8_t type = 1) {
  return {object::kTpdo1CobId, object::kTpdo1Count, tpdo1(bench), type};
}

void map_wheel(DriveBench& bench) {
  map(bench, command_pdo(bench), {map_controlword(), map_target()});
  map(bench, feedback_pdo(bench), {map_statusword(), map_position()});
}

void sync(DriveBench& bench) {
  bench.send(drivers::sync_frame());
  bench.wait(milliseconds(4));
}

void command(DriveBench& bench, std::uint16_t word, std::int32_t target) {
  hal::CanFrame frame{.id = static_cast<std::uint16_t>(rpdo1(bench)), .size = 6, .data = {}};
  drivers::store(std::span(frame.data), word);
  drivers::store(std::span(frame.data).subspan(2), std::bit_cast<std::uint32_t>(target));
  bench.send(frame);
  bench.wait(milliseconds(2));
}

void maps_only_in_order(DriveBench& bench) {
  if (bench.write(object::kRpdo1CobId, 4, rpdo1(bench)).abort == kReadOnly) {
    throw NotThere("PDO mappings cannot be written");
  }
  require(bench.write(object::kRpdo1Count, 1, 0).abort != 0, "the mapping of a valid PDO can be emptied");
  bench.must_write(object::kRpdo1CobId, 4, rpdo1(bench) | kInvalid);
  bench.must_write(object::kRpdo1Count, 1, 0);
  bench.must_write({0x1600, 1}, 4, map_controlword());
  bench.must_write({0x1600, 2}, 4, map_target());
  bench.must_write(object::kRpdo1Count, 1, 2);
  require(bench.write({0x1600, 1}, 4, map_target()).abort != 0, "an entry of a counted mapping can be written");
}

void refuses_what_cannot_be_mapped(DriveBench& bench) {
  map(bench, command_pdo(bench), {map_controlword()});
  bench.must_write(object::kRpdo1CobId, 4, rpdo1(bench) | kInvalid);
  bench.must_write(object::kRpdo1Count, 1, 0);
  bench.must_refuse({0x1600, 1}, 4, object::mapped(object::kDeviceType, 32), 0x06040041);
  bench.must_refuse({0x1600, 1}, 4, map_statusword(), 0x06040041);
  const std::uint32_t wrong_bits = bench.write({0x1600, 1}, 4, object::mapped(object::kControlword, 32)).abort;
  require(wrong_bits == 0x06040041 || wrong_bits == 0x06040042, "32 bits of 6040h can be mapped");
  for (std::uint8_t n = 1; n <= 3; ++n) {
    if (bench.write({0x1600, n}, 4, map_target()).abort == 0x06090011) {
      throw NotThere("less than three objects can be mapped");
    }
  }
  bench.must_refuse(object::kRpdo1Count, 1, 3, 0x06040042);
}

void refuses_restricted_cob_ids(DriveBench& bench) {
  if (bench.write(object::kTpdo1CobId, 4, tpdo1(bench) | kInvalid).abort == kReadOnly) {
    throw NotThere("COB-IDs cannot be written");
  }
  for (const std::uint32_t id : {0x000U, 0x07FU, 0x080U, 0x181U - 1, 0x600U + bench.node(), 0x701U, 0x20000181U}) {
    bench.must_refuse(object::kTpdo1CobId, 4, id, 0x06090030);
  }
  bench.must_write(object::kTpdo1CobId, 4, tpdo1(bench));
  bench.must_refuse(object::kTpdo1CobId, 4, tpdo1(bench) + 0x100, 0x06090030);
}

void keeps_its_mapping_while_operational(DriveBench& bench) {
  map_wheel(bench);
  bench.watch_states();
  bench.nmt(NmtCommand::kStart);
  bench.expect_state(NmtState::kOperational);
  require(bench.write(object::kTpdo1Count, 1, 0).abort != 0, "a mapping can be emptied in Operational");
  require(bench.must_read(object::kTpdo1Count) == 2, "a mapping was emptied in Operational");
}

void answers_each_sync(DriveBench& bench) {
  map_wheel(bench);
  bench.bring_to(PowerState::kSwitchOnDisabled);
  for (int i = 0; i < 20; ++i) {
    bench.forget();
    sync(bench);
    bench.expect("TPDO1", [&](const hal::CanFrame& frame) { return frame.id == tpdo1(bench) && frame.size == 6; });
    bench.wait(milliseconds(4));
    require(bench.count(static_cast<std::uint16_t>(tpdo1(bench))) == 1, "a SYNC is answered by more than one TPDO1");
  }
  const hal::CanFrame feedback =
      bench.expect("TPDO1", [&](const hal::CanFrame& frame) { return frame.id == tpdo1(bench); });
  require(drivers::load<std::uint16_t>(feedback.data) == bench.statusword(), "TPDO1 does not say what 6041h says");
  bench.forget();
  bench.wait(milliseconds(200));
  require(bench.count(static_cast<std::uint16_t>(tpdo1(bench))) == 0, "a TPDO1 of type 1 comes without SYNC");
}

void answers_every_third_sync(DriveBench& bench) {
  map(bench, feedback_pdo(bench, 3), {map_statusword(), map_position()});
  bench.bring_to(PowerState::kSwitchOnDisabled);
  bench.forget();
  for (int i = 0; i < 12; ++i) {
    sync(bench);
  }
  bench.wait(milliseconds(50));
  require(bench.count(static_cast<std::uint16_t>(tpdo1(bench))) == 4, "12 SYNCs are not answered by 4 TPDO1 of type 3");
}

void keeps_process_data_to_operational(DriveBench& bench) {
  map_wheel(bench);
  bench.forget();
  sync(bench);
  command(bench, controlword::kShutdown, 0);
  sync(bench);
  require(bench.count(static_cast<std::uint16_t>(tpdo1(bench))) == 0, "a TPDO1 comes in Pre-operational");
  require(bench.power() == PowerState::kSwitchOnDisabled, "an RPDO1 acts in Pre-operational");
}

void acts_at_the_next_sync(DriveBench& bench) {
  map_wheel(bench);
  bench.bring_to(PowerState::kSwitchOnDisabled);
  command(bench, controlword::kShutdown, 0);
  require(bench.power() == PowerState::kSwitchOnDisabled, "an RPDO1 of type 1 acts before SYNC");
  sync(bench);
  bench.expect_power(PowerState::kReadyToSwitchOn, "after RPDO1 and SYNC");
}

void acts_at_once_when_event_driven(DriveBench& bench) {
  map(bench, command_pdo(bench, 255), {map_controlword(), map_target()});
  bench.bring_to(PowerState::kSwitchOnDisabled);
  command(bench, controlword::kShutdown, 0);
  bench.expect_power(PowerState::kReadyToSwitchOn, "after RPDO1 of type 255");
}

void refuses_a_short_command(DriveBench& bench) {
  map_wheel(bench);
  bench.bring_to(PowerState::kSwitchOnDisabled);
  bench.forget();
  bench.send({.id = static_cast<std::uint16_t>(rpdo1(bench)), .size = 4, .data = {0x06}});
  bench.wait(milliseconds(2));
  sync(bench);
  bench.expect("emergency 8210h", [&](const hal::CanFrame& frame) {
    return frame.id == drivers::cob_id::emcy(bench.node()) && frame.data[0] == 0x10 && frame.data[1] == 0x82;
  });
  require(bench.power() == PowerState::kSwitchOnDisabled, "a short RPDO1 acts");
}

void passes_over_dummies(DriveBench& bench) {
  const Pdo pdo = command_pdo(bench);
  map(bench, pdo, {map_controlword()});
  bench.must_write(pdo.cob_id_object, 4, pdo.cob_id | kInvalid);
  bench.must_write(pdo.count, 1, 0);
  if (bench.write({0x1600, 1}, 4, kDummy).abort == 0x06040041) {
    throw NotThere("dummy entries cannot be mapped");
  }
  map(bench, pdo, {kDummy, map_target()});
  bench.bring_to(PowerState::kSwitchOnDisabled);
  bench.send({.id = static_cast<std::uint16_t>(rpdo1(bench)), .size = 8, .data = {1, 2, 3, 4, 0x39, 0x30, 0, 0}});
  bench.wait(milliseconds(2));
  sync(bench);
  require(bench.must_read(object::kTargetVelocity) == 12345, "60FFh after a dummy is not taken");
}

void misses_its_commands(DriveBench& bench) {
  map_wheel(bench);
  const Reply deadline = bench.write({0x1400, 5}, 2, 200);
  if (deadline.abort != 0) {
    throw NotThere("1400h:5 is not there");
  }
  bench.bring_to(PowerState::kSwitchOnDisabled);
  command(bench, controlword::kDisableVoltage, 0);
  bench.forget();
  bench.expect("emergency 8250h", [&](const hal::CanFrame& frame) {
    return frame.id == drivers::cob_id::emcy(bench.node()) && frame.data[0] == 0x50 && frame.data[1] == 0x82;
  });
}

void tells_of_changes_and_by_timer(DriveBench& bench) {
  map(bench, feedback_pdo(bench, 255), {map_statusword()});
  bench.bring_to(PowerState::kSwitchOnDisabled);
  bench.wait(milliseconds(100));
  bench.forget();
  bench.wait(milliseconds(200));
  require(bench.count(static_cast<std::uint16_t>(tpdo1(bench))) == 0, "an event-driven TPDO1 comes without an event");
  bench.control(controlword::kShutdown);
  bench.expect("TPDO1 after a change of the statusword", [&](const hal::CanFrame& frame) {
    return frame.id == tpdo1(bench) &&
           drivers::cia402::power_state(drivers::load<std::uint16_t>(frame.data)) == PowerState::kReadyToSwitchOn;
  });
  bench.nmt(NmtCommand::kEnterPreOperational);
  bench.expect_state(NmtState::kPreOperational);
  bench.must_write({0x1800, 5}, 2, 20);
  bench.nmt(NmtCommand::kStart);
  bench.expect_state(NmtState::kOperational);
  for (int i = 0; i < 3; ++i) {
    bench.forget();
    bench.expect("TPDO1 by its timer", [&](const hal::CanFrame& frame) { return frame.id == tpdo1(bench); });
  }
}

const std::array kChecks = {
    Check{"TakesAMappingOnlyInTheOrderOfTheStandard", false, maps_only_in_order},
    Check{"RefusesWhatCannotBeMapped", false, refuses_what_cannot_be_mapped},
    Check{"RefusesRestrictedCobIds", false, refuses_restricted_cob_ids},
    Check{"KeepsItsMappingWhileOperational", false, keeps_its_mapping_while_operational},
    Check{"AnswersEachSyncOnce", false, answers_each_sync},
    Check{"AnswersEveryThirdSync", false, answers_every_third_sync},
    Check{"KeepsProcessDataToOperational", false, keeps_process_data_to_operational},
    Check{"ActsAtTheNextSync", false, acts_at_the_next_sync},
    Check{"ActsAtOnceWhenEventDriven", false, acts_at_once_when_event_driven},
    Check{"RefusesAShortCommandWithAnEmergency", false, refuses_a_short_command},
    Check{"PassesOverDummyEntries", false, passes_over_dummies},
    Check{"MissesItsCommands", false, misses_its_commands},
    Check{"TellsOfChangesAndByTimer", false, tells_of_changes_and_by_timer},
};

}  // namespace

std::span<const Check> pdo_checks() { return kChecks; }

}  // namespace ivo::contract
