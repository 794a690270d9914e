// Emergencies, error register and history (CiA 301, 7.2.7 and 7.5.2.2 to 7.5.2.4).
#include <array>
#include <chrono>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/emcy.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/objects.hpp"
#include "tests/contract/drive_contract.hpp"

namespace ivo::contract {
namespace {

using drivers::cia402::PowerState;
using std::chrono::milliseconds;
namespace object = drivers::object;

constexpr drivers::ObjectAddress kHistory{0x1003, 0};

bool is_emergency(const DriveBench& bench, const hal::CanFrame& frame) {
  return frame.id == drivers::cob_id::emcy(bench.node());
}

void tells_of_a_fault_once(DriveBench& bench) {
  bench.bring_to_fault();
  const hal::CanFrame first =
      bench.expect("emergency", [&](const hal::CanFrame& frame) { return is_emergency(bench, frame); });
  const auto emergency = drivers::parse_emergency(first);
  require(emergency.has_value(), "an emergency has not 8 bytes");
  require(emergency->code != 0 && (emergency->error_register & 1) != 0, "an emergency says that nothing is wrong");
  require(bench.must_read(object::kErrorRegister) == emergency->error_register, "1001h is not what the emergency said");
  require(bench.must_read(object::kErrorCode) == emergency->code, "603Fh is not what the emergency said");
  bench.forget();
  bench.wait(milliseconds(200));
  require(!bench.heard([&](const hal::CanFrame& frame) { return is_emergency(bench, frame); }),
          "an emergency is told twice");
}

void tells_that_all_is_well(DriveBench& bench) {
  bench.bring_to_fault();
  bench.forget();
  bench.control(drivers::cia402::controlword::kFaultReset);
  bench.expect("emergency 0000h", [&](const hal::CanFrame& frame) {
    return is_emergency(bench, frame) && frame.data[0] == 0 && frame.data[1] == 0;
  });
  require(bench.must_read(object::kErrorRegister) == 0, "1001h is not 0 after the fault was reset");
}

void remembers_its_errors(DriveBench& bench) {
  if (!bench.has(kHistory)) {
    throw NotThere("1003h is not there");
  }
  bench.must_write(kHistory, 1, 0);
  require(bench.must_read(kHistory) == 0, "1003h is not emptied by 0");
  bench.bring_to_fault();
  require(bench.must_read(kHistory) == 1, "1003h does not count one error");
  require((bench.must_read({0x1003, 1}) & 0xFFFF) == bench.must_read(object::kErrorCode),
          "1003h:1 is not the error that was told");
  bench.must_refuse(kHistory, 1, 5, 0x06090030);
  bench.must_write(kHistory, 1, 0);
  require(bench.must_read(kHistory) == 0, "1003h is not emptied by 0");
}

const std::array kChecks = {
    Check{"TellsOfAFaultOnce", false, tells_of_a_fault_once},
    Check{"TellsThatAllIsWellAgain", false, tells_that_all_is_well},
    Check{"RemembersItsErrors", false, remembers_its_errors},
};

}  // namespace

std::span<const Check> emergency_checks() { return kChecks; }

}  // namespace ivo::contract
