// The SDO server (CiA 301, 7.2.4).
#include <array>
#include <string>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/cia402/objects.hpp"
#include "tests/contract/drive_contract.hpp"

namespace ivo::contract {
namespace {

namespace object = drivers::object;

constexpr drivers::ObjectAddress kDeviceName{0x1008, 0};
constexpr drivers::ObjectAddress kUserName{0x2000, 0};
constexpr drivers::ObjectAddress kNoObject{0x5FFF, 0};
constexpr drivers::ObjectAddress kNoSub{0x1018, 99};

std::uint16_t request_id(const DriveBench& bench) { return drivers::cob_id::sdo_request(bench.node()); }

void says_what_it_is(DriveBench& bench) {
  require((bench.must_read(object::kDeviceType) & 0xFFFF) == 402, "1000h does not say CiA 402");
  require(bench.read(object::kDeviceType).bytes.size() == 4, "1000h has not 4 bytes");
  require(bench.read(object::kErrorRegister).bytes.size() == 1, "1001h has not 1 byte");
  require(bench.read(object::kStatusword).bytes.size() == 2, "6041h has not 2 bytes");
  require(bench.must_read({0x1018, 0}) >= 1, "1018h has no entries");
  (void)bench.must_read(object::kVendorId);
}

void refuses_by_the_standard(DriveBench& bench) {
  const auto refused = [&](drivers::ObjectAddress address, std::uint32_t abort) {
    const Reply reply = bench.read(address);
    require(reply.abort == abort, "the upload of " + name_of(address) + " ends with " + hexadecimal(reply.abort, 8) +
                                      "; expected abort " + hexadecimal(abort, 8));
  };
  refused(kNoObject, 0x06020000);
  refused(kNoSub, 0x06090011);
  bench.must_refuse(object::kDeviceType, 4, 0, 0x06010002);
  const std::uint32_t longer = bench.write(object::kModeOfOperation, 4, 0).abort;
  require(longer == 0x06070010 || longer == 0x06070012, "1 byte of 6060h takes 4");
  const std::uint32_t shorter = bench.write(object::kTargetVelocity, 2, 0).abort;
  require(shorter == 0x06070010 || shorter == 0x06070013, "4 bytes of 60FFh take 2");
}

void refuses_unknown_commands(DriveBench& bench) {
  for (const std::uint8_t command : std::array<std::uint8_t, 3>{0xE0, 0x60, 0x00}) {
    const auto answer = bench.ask(drivers::sdo_frame(request_id(bench), {command, object::kDeviceType, 0}));
    require(answer.has_value() && answer->data[0] == 0x80 && drivers::parse_sdo(*answer)->data == 0x05040001,
            "command " + hexadecimal(command, 2) + " out of place is not aborted with 05040001h");
  }
}

void leaves_short_requests_alone(DriveBench& bench) {
  require(!bench.ask({.id = request_id(bench), .size = 4, .data = {0x40, 0x00, 0x10, 0x00}}).has_value(),
          "a request of 4 bytes is answered");
  require(!bench.ask(drivers::sdo_frame(request_id(bench), {0x80, object::kDeviceType, 0x05040000})).has_value(),
          "an abort is answered");
}

void gives_strings_in_segments(DriveBench& bench) {
  const Reply name = bench.read(kDeviceName);
  if (name.abort == 0x06020000) {
    throw NotThere("1008h is not there");
  }
  require(name.abort == 0 && !name.bytes.empty(), "1008h cannot be read");
}

void minds_the_toggle(DriveBench& bench) {
  const auto first = bench.ask(drivers::sdo_frame(request_id(bench), {0x40, kDeviceName, 0}));
  if (!first.has_value() || (first->data[0] & 0xE2) != 0x40) {
    throw NotThere("1008h does not come in segments");
  }
  const auto wrong = bench.ask({.id = request_id(bench), .size = 8, .data = {0x70}});
  require(wrong.has_value() && wrong->data[0] == 0x80 && drivers::parse_sdo(*wrong)->data == 0x05030000,
          "a segment asked for with the wrong toggle is not aborted with 05030000h");
  (void)bench.must_read(object::kDeviceType);
}

void forgets_an_aborted_transfer(DriveBench& bench) {
  const auto first = bench.ask(drivers::sdo_frame(request_id(bench), {0x40, kDeviceName, 0}));
  if (!first.has_value() || (first->data[0] & 0xE2) != 0x40) {
    throw NotThere("1008h does not come in segments");
  }
  bench.send(drivers::sdo_frame(request_id(bench), {0x80, kDeviceName, 0x05040000}));
  const auto segment = bench.ask({.id = request_id(bench), .size = 8, .data = {0x60}});
  require(segment.has_value() && segment->data[0] == 0x80, "a transfer goes on after an abort");
  (void)bench.must_read(object::kDeviceType);
}

void takes_small_objects_in_segments(DriveBench& bench) {
  const Reply reply = bench.write_segments(object::kTargetVelocity, {0x39, 0x30, 0x00, 0x00});
  if (reply.abort == 0x05040001) {
    throw NotThere("no downloads in segments");
  }
  require(reply.abort == 0, "60FFh in segments is aborted: " + hexadecimal(reply.abort, 8));
  require(bench.must_read(object::kTargetVelocity) == 12345, "60FFh in segments is confirmed and not there");
  const std::uint32_t longer = bench.write_segments(object::kTargetVelocity, std::vector<std::uint8_t>(9)).abort;
  require(longer == 0x06070010 || longer == 0x06070012, "60FFh takes 9 bytes in segments");
  bench.must_write(object::kTargetVelocity, 4, 0);
}

void keeps_a_string(DriveBench& bench) {
  if (!bench.has(kUserName)) {
    throw NotThere("2000h is not there");
  }
  for (const std::string name : {"rear left wheel, as it is", "seven b", ""}) {
    const Reply written = bench.write_segments(kUserName, {name.begin(), name.end()});
    require(written.abort == 0, "2000h is aborted: " + hexadecimal(written.abort, 8));
    const Reply read = bench.read(kUserName);
    require(std::string(read.bytes.begin(), read.bytes.end()) == name, "2000h does not keep \"" + name + "\"");
  }
}

const std::array kChecks = {
    Check{"SaysWhatItIs", false, says_what_it_is},
    Check{"RefusesByTheStandardsCodes", false, refuses_by_the_standard},
    Check{"RefusesCommandsOutOfPlace", false, refuses_unknown_commands},
    Check{"LeavesShortRequestsAndAbortsAlone", false, leaves_short_requests_alone},
    Check{"GivesStringsInSegments", false, gives_strings_in_segments},
    Check{"MindsTheToggleBit", false, minds_the_toggle},
    Check{"ForgetsAnAbortedTransfer", false, forgets_an_aborted_transfer},
    Check{"TakesSmallObjectsInSegments", false, takes_small_objects_in_segments},
    Check{"KeepsAString", false, keeps_a_string},
};

}  // namespace

std::span<const Check> sdo_checks() { return kChecks; }

}  // namespace ivo::contract
