// 16 to 18 and 20: what start-up finds. Nothing has moved yet, and nothing will.
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "firmware/tools/bench/can/fault_row.hpp"

namespace ivo::firmware::bench {
namespace {

using Frames = std::vector<hal::CanFrame>;

constexpr std::uint16_t kAnswer = drivers::cob_id::sdo_answer(3);

/// Changes the drive's SDO answers.
void answers(FaultRig& rig, std::function<void(hal::CanFrame&)> change) {
  rig.meddle().outgoing = [change = std::move(change)](Frames& frames) {
    for (hal::CanFrame& frame : frames) {
      if (frame.id == kAnswer) {
        change(frame);
      }
    }
  };
}

FaultRow at_start(int number, const char* name, const char* by, const char* says,
                  std::function<void(FaultRig&)> provoke, std::function<void(FaultRig&)> mend) {
  return {.number = number,
          .name = name,
          .by = by,
          .outcome = Outcome::kNoStart,
          .says = says,
          .provoke = std::move(provoke),
          .mend = std::move(mend)};
}

}  // namespace

std::vector<FaultRow> faults_at_start() {
  return {
      at_start(
          16, "an SDO is aborted", "1017h of drive 3 is read-only",
          "drive 3 (rear left) failed at \"producer heartbeat time 1017h\": SDO abort 06010002h, *",
          [](FaultRig& rig) {
            victim(rig).refusal = {.object = drivers::object::kProducerHeartbeat,
                                   .code = drivers::SdoAbort{0x0601'0002}};
          },
          [](FaultRig& rig) { victim(rig).refusal.reset(); }),
      at_start(
          16, "SDO answers do not come", "583h dropped",
          "drive 3 (rear left) failed at \"device type 1000h\": no SDO answer",
          [](FaultRig& rig) {
            rig.meddle().outgoing = [](Frames& frames) {
              std::erase_if(frames, [](const hal::CanFrame& frame) { return frame.id == kAnswer; });
            };
          },
          no_meddling),
      at_start(
          16, "SDO answers are of another object", "index in 583h changed",
          "drive 3 (rear left) failed at \"device type 1000h\": *",
          [](FaultRig& rig) { answers(rig, [](hal::CanFrame& frame) { frame.data[1] ^= 0x01; }); }, no_meddling),
      at_start(
          16, "SDO answers are of a command that does not exist", "583h with command E0h",
          "drive 3 (rear left) failed at \"device type 1000h\": *",
          [](FaultRig& rig) { answers(rig, [](hal::CanFrame& frame) { frame.data[0] = 0xE0; }); }, no_meddling),
      at_start(
          16, "SDO segments have the wrong toggle bit", "toggle bit of 583h inverted",
          "drive 3 (rear left) failed at \"*\": SDO abort 05030000h, *",
          [](FaultRig& rig) {
            (void)victim(rig).events.push_back({.fault = drivers::SimFault::kSdoSegmented});
            (void)victim(rig).events.push_back({.fault = drivers::SimFault::kSdoToggle});
          },
          [](FaultRig& rig) {
            (void)victim(rig).events.push_back({.at = rig.now(), .fault = drivers::SimFault::kSdoToggle, .on = false});
          }),
      at_start(
          17, "another make of drive", "1018h:1 of drive 3 is BBh",
          "drive 3 (rear left) failed at \"vendor-ID 1018h:1\": unexpected value 000000BBh",
          [](FaultRig& rig) {
            victim(rig).stuck = {.object = drivers::object::kVendorId, .value = 0xBB, .code = std::nullopt};
          },
          [](FaultRig& rig) { victim(rig).stuck.reset(); }),
      at_start(
          18, "the mode of operation is not taken", "6061h of drive 3 stays 0",
          "drive 3 (rear left) failed at \"mode of operation 6061h\": unexpected value 00000000h",
          [](FaultRig& rig) { victim(rig).refuse_mode = true; },
          [](FaultRig& rig) { victim(rig).refuse_mode = false; }),
  };
}

}  // namespace ivo::firmware::bench
