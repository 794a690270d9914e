// 11, 12 and 26: somebody else on the bus who should not be there.
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "firmware/tools/bench/can/fault_row.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

std::string foreign(std::uint16_t id) {
  return format("another master on the bus sent COB-ID %03Xh; expected none but this controller", id);
}

FaultRow second_master(const char* name, std::uint16_t id, std::function<void(FaultRig&)> provoke) {
  return {.number = 26,
          .name = name,
          .by = format("one %03Xh by a third socket", id),
          .says = foreign(id),
          .detected_within = kAtOnce,
          .provoke = std::move(provoke)};
}

}  // namespace

std::vector<FaultRow> faults_of_others() {
  return {
      {.number = 11,
       .name = "a second source of SYNC",
       .by = "080h each cycle by a third socket",
       .says = foreign(0x080),
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { rig.each_cycle([](FaultRig& each) { each.injector().send(0x080, {}); }); }},
      {.number = 11,
       .name = "SYNC reaches no drive any more",
       .by = "080h dropped before the drives",
       .outcome = Outcome::kStopsBus,
       .says = "drive 1 (front left): feedback lost: TPDO1 does not arrive",
       .detected_within = rates::kFeedbackTimeout + kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             rig.meddle().incoming = [](std::vector<hal::CanFrame>& frames) {
               std::erase_if(frames, [](const hal::CanFrame& frame) { return frame.id == 0x080; });
             };
           },
       .mend = [](FaultRig& rig) { rig.meddle().incoming = nullptr; }},
      {.number = 12,
       .name = "two devices with one node-id: two heartbeats",
       .by = "703h every 50 ms by a third socket",
       .says = "drive 3 (rear left): two devices answer to this node-id; expected one each",
       .detected_within = 200ms,
       .provoke =
           [](FaultRig& rig) {
             rig.each_cycle([cycles = 0](FaultRig& each) mutable {
               if (cycles++ % 25 == 12) {
                 each.injector().send(0x703, {0x05});
               }
             });
           }},
      {.number = 12,
       .name = "two devices with one node-id: the second boots",
       .by = "a boot-up 703h by a third socket",
       .says = "drive 3 (rear left): rebooted",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { rig.injector().send(0x703, {0x00}); }},
      {.number = 12,
       .name = "somebody has our node-id",
       .by = "77Fh by a third socket",
       .says = foreign(0x77F),
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { rig.injector().send(0x77F, {0x05}); }},
      second_master("a second master: NMT", 0x000,
                    [](FaultRig& rig) {
                      rig.injector().send(0x000, {0x01, 0x00});
                    }),
      second_master("a second master: an SDO request", 0x603,
                    [](FaultRig& rig) {
                      rig.injector().send(0x603, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
                    }),
      second_master("a second master: a command that turns a wheel", 0x203,
                    [](FaultRig& rig) {
                      rig.injector().send(0x203, {0x0F, 0x00, 0x10, 0x27, 0x00, 0x00});
                    }),
  };
}

}  // namespace ivo::firmware::bench
