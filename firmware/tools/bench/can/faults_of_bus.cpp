// 4 to 7 and 13: the controller, the interface and its queues.
#include <linux/can.h>
#include <linux/can/error.h>

#include "config/rates.hpp"
#include "firmware/tools/bench/can/fault_row.hpp"

namespace ivo::firmware::bench {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

constexpr int kSmallQueueBytes = 23'000;      // the kernel doubles it: 60 frames of 766 bytes
constexpr std::uint32_t kErrorsGone = 0x084;  // emergencies of drive 4 with code 0: heard, and no fault

void add_interface(FaultRig& rig) {
  rig.tool({"ip", "link", "add", "dev", FaultRig::kMasterSide, "type", "vcan"});
  rig.tool({"ip", "link", "set", FaultRig::kMasterSide, "up"});
}

void remove_interface(FaultRig& rig) {
  rig.tool({"ip", "link", "del", FaultRig::kMasterSide});
  rig.at_end({"ip", "link", "set", FaultRig::kMasterSide, "up"});
  rig.at_end({"ip", "link", "add", "dev", FaultRig::kMasterSide, "type", "vcan"});
}

void set_interface(FaultRig& rig, const char* state) {
  rig.tool({"ip", "link", "set", FaultRig::kMasterSide, state});
  rig.at_end({"ip", "link", "set", FaultRig::kMasterSide, "up"});
}

void burst(FaultRig& rig, int frames) { rig.injector().flood(frames, kErrorsGone, {0, 0, 0, 0, 0, 0, 0, 0}); }

/// One frame fits, and leaves after minutes.
void block_queue(FaultRig& rig) {
  rig.tool({"tc", "qdisc", "add", "dev", FaultRig::kMasterSide, "root", "tbf", "rate", "8bit", "burst", "16", "limit",
            "16"});
  rig.at_end({"tc", "qdisc", "del", "dev", FaultRig::kMasterSide, "root"});
}

void unblock_queue(FaultRig& rig) { rig.tool({"tc", "qdisc", "del", "dev", FaultRig::kMasterSide, "root"}); }

void lose_all_sent(FaultRig& rig) {
  rig.tool({"tc", "qdisc", "add", "dev", FaultRig::kMasterSide, "root", "netem", "loss", "100%"});
  rig.at_end({"tc", "qdisc", "del", "dev", FaultRig::kMasterSide, "root"});
}

}  // namespace

std::vector<FaultRow> faults_of_bus() {
  return {
      {.number = 4,
       .name = "the controller is bus-off",
       .by = "cansend of an error frame, class 40h",
       .outcome = Outcome::kStopsBus,
       .says = "bus lost: bus-off",
       .detected_within = kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             rig.tool({"cansend", FaultRig::kMasterSide, "20000040#0000000000000000"});
           },
       .mend =
           [](FaultRig& rig) {
             rig.injector().send(CAN_ERR_FLAG | CAN_ERR_RESTARTED, {0, 0, 0, 0, 0, 0, 0, 0});
           },
       .also_at_1khz = true},
      {.number = 4,
       .name = "the controller is error passive",
       .by = "cansend of an error frame, class 04h",
       .says = "bus lost: error passive",
       .detected_within = kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             rig.tool({"cansend", FaultRig::kMasterSide, "20000004#0010000000000000"});
           },
       .mend =
           [](FaultRig& rig) {
             rig.tool({"cansend", FaultRig::kMasterSide, "20000004#0040000000000000"});
           }},
      {.number = 4,
       .name = "nothing that is sent leaves: alone on the bus",
       .by = "tc netem loss 100%",
       .outcome = Outcome::kStopsBus,
       .says = "commands do not get out: no other node acknowledges them, the transmit queue is full, or the interface "
               "is down",
       .detected_within = rates::kFeedbackTimeout + kAtOnce,
       .provoke = lose_all_sent,
       .mend = unblock_queue},
      {.number = 5,
       .name = "the transmit queue is full for three cycles",
       .by = "tc tbf, ENOBUFS for 3 cycles",
       .outcome = Outcome::kGoesOn,
       .says = "no fault",
       .provoke =
           [](FaultRig& rig) {
             block_queue(rig);
             rig.each_cycle([cycles = 0](FaultRig& each) mutable {
               if (cycles++ == 3) {
                 unblock_queue(each);
               }
             });
           }},
      {.number = 5,
       .name = "the transmit queue is full and stays so",
       .by = "tc tbf, ENOBUFS from now on",
       .outcome = Outcome::kStopsBus,
       .says = "commands do not get out: no other node acknowledges them, the transmit queue is full, or the interface "
               "is down",
       .detected_within = 10ms + kAtOnce,
       .provoke = block_queue,
       .mend = unblock_queue,
       .also_at_1khz = true},
      {.number = 6,
       .name = "the interface goes down",
       .by = "ip link set vcan0 down",
       .outcome = Outcome::kStopsBus,
       .says = "bus lost: the interface is down",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { set_interface(rig, "down"); },
       .mend = [](FaultRig& rig) { set_interface(rig, "up"); }},
      {.number = 6,
       .name = "the interface goes down and comes up within a cycle",
       .by = "ip link set vcan0 down, up",
       .outcome = Outcome::kStopsBus,
       .says = "bus lost: the interface is down",
       .detected_within = kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             set_interface(rig, "down");
             set_interface(rig, "up");
           }},
      {.number = 6,
       .name = "the interface is removed and put in again",
       .by = "ip link del vcan0, add",
       .outcome = Outcome::kStopsBus,
       .says = "bus lost: the interface was removed",
       .detected_within = kAtOnce,
       .provoke = remove_interface,
       .mend = add_interface},
      {.number = 7,
       .name = "the receive queue overflows",
       .by = "150 of 084h at once, room for 60",
       .says = "* frames were lost on the way in: the receive queue overflowed",
       .detected_within = 2 * kAtOnce,
       .provoke = [](FaultRig& rig) { burst(rig, 150); },
       .loses_frames = true,
       .receive_bytes = kSmallQueueBytes},
      {.number = 7,
       .name = "ten thousand frames at once: the queue as it is",
       .by = "10,000 of 084h by a third socket",
       .says = "bus flooded: * frames in one cycle",  // what fills that queue is a flood before it is lost
       .detected_within = 10 * rates::kCycle,
       .provoke = [](FaultRig& rig) { burst(rig, 10'000); },
       .loses_frames = true},
      {.number = 13,
       .name = "a babbling node: id 0 as fast as it goes",
       .by = "200 of 000h a cycle by a third socket",
       .says = "another master on the bus sent COB-ID 000h; expected none but this controller",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { rig.each_cycle([](FaultRig& each) { each.injector().flood(200, 0x000, {}); }); }},
      {.number = 13,
       .name = "a babbling node that lets no other frame through",
       .by = "as before, and only 000h reaches the drives",
       .outcome = Outcome::kStopsBus,
       .says = "another master on the bus sent COB-ID 000h; expected none but this controller",
       .detected_within = kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             rig.meddle().incoming = [](std::vector<hal::CanFrame>& frames) {
               std::erase_if(frames, [](const hal::CanFrame& frame) { return frame.id != 0x000; });
             };
             rig.each_cycle([](FaultRig& each) { each.injector().flood(200, 0x000, {}); });
           },
       .mend = [](FaultRig& rig) { rig.meddle().incoming = nullptr; }},
      {.number = 13,
       .name = "a babbling node: \"no error any more\" as fast as it goes",
       .by = "100 of 084h a cycle by a third socket",
       .says = "bus flooded: * frames in one cycle",
       .detected_within = 10 * rates::kCycle,
       .provoke =
           [](FaultRig& rig) {
             rig.each_cycle([](FaultRig& each) { each.injector().flood(100, kErrorsGone, {0, 0, 0, 0, 0, 0, 0, 0}); });
           }},
  };
}

}  // namespace ivo::firmware::bench
