// Every decoder of a frame, on frames of any identifier, length and content.
#include <linux/can/error.h>

#include "drivers/canopen/bus_load.hpp"
#include "drivers/canopen/emcy.hpp"
#include "drivers/canopen/frame_bits.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/statusword.hpp"
#include "hal/linux/error_frame.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo;
using fuzz::require;

bool same(const hal::CanFrame& a, const hal::CanFrame& b) { return a == b; }

void decode(const hal::CanFrame& frame) {
  if (const auto order = drivers::parse_nmt(frame)) {
    require(same(drivers::nmt_frame(*order), frame), "an NMT order is written as it was read");
  }
  if (const auto state = drivers::parse_heartbeat(frame)) {
    require(frame.size == 1 && (frame.id & 0x780) == 0x700, "a heartbeat is one byte of 700h + node-id");
    require((static_cast<unsigned>(*state) & 0x80U) == 0, "the toggle bit of node guarding is no state");
  }
  if (const auto emergency = drivers::parse_emergency(frame)) {
    require(frame.size == 8 && frame.id != 0x080, "an emergency is eight bytes, and no SYNC");
  }
  if (const auto message = drivers::parse_sdo(frame)) {
    require(same(drivers::sdo_frame(frame.id, *message), frame), "an SDO is written as it was read");
    (void)drivers::name_of(drivers::SdoAbort{message->data});
    for (const std::uint8_t bytes : {1, 2, 3, 4}) {
      (void)drivers::low_bytes(message->data, bytes);
    }
    require(drivers::sdo_command::bytes_in(message->command).value_or(1) <= 4, "an expedited SDO holds four bytes");
  }
  if (const auto status = drivers::parse_status(frame)) {
    require(frame.size == drivers::kPdoBytes, "feedback has the length that was mapped");
    const drivers::cia402::PowerState state = drivers::cia402::power_state(status->statusword);
    for (const auto goal :
         {drivers::cia402::PowerState::kReadyToSwitchOn, drivers::cia402::PowerState::kOperationEnabled}) {
      const std::uint16_t word = drivers::cia402::toward(state, goal);
      require((word & 0x80U) == 0, "no way to a state leads through a fault reset");
      require((word & 0x8FU) != 0x0F || goal == drivers::cia402::PowerState::kOperationEnabled,
              "operation is enabled only when it is the goal");
    }
  }
  if (const auto pair = drivers::parse_target_pair(frame)) {
    require(same(drivers::target_pair_frame(frame.id, *pair), frame), "a pair of targets is written as it was read");
  }
  const int bits = drivers::bits_on_wire(frame);
  require(bits >= drivers::unstuffed_bits(frame.size) && bits <= drivers::longest_bits(frame.size),
          "a frame is as long as stuffing makes it");
  require(static_cast<std::size_t>(drivers::kind_of(frame.id)) < drivers::kFrameKinds, "a frame is of some kind");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  while (!input.empty()) {
    if (input.up_to(3) == 0) {
      can_frame error{};
      error.can_id = input.take<std::uint32_t>() | CAN_ERR_FLAG;
      error.can_dlc = static_cast<std::uint8_t>(input.up_to(8));
      for (std::uint8_t& byte : error.data) {
        byte = input.byte();
      }
      const auto state = hal::state_told_by(error);
      require((error.can_id & CAN_ERR_BUSOFF) == 0 || state == hal::BusState::kOff, "bus-off is bus-off");
    } else {
      decode(input.frame(input.take<std::uint16_t>() & 0x7FF));
    }
  }
  return 0;
}
