// 8, 10, 15 and 27: what a drive says comes missing, late, twice, in another order, damaged, or is not so.
#include <linux/can.h>

#include <array>
#include <memory>

#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "firmware/tools/bench/can/fault_row.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;
using Frames = std::vector<hal::CanFrame>;

constexpr std::uint16_t kFeedback = drivers::cob_id::tpdo1(3);

bool is_feedback(const hal::CanFrame& frame) { return frame.id == kFeedback; }

/// Every `one_in`th feedback of the drive is lost.
void lose(FaultRig& rig, int one_in) {
  rig.meddle().outgoing = [one_in, count = 0](Frames& frames) mutable {
    std::erase_if(frames, [&](const hal::CanFrame& frame) { return is_feedback(frame) && ++count % one_in == 0; });
  };
}

/// Loses the next `count` feedbacks of the drive, then none.
void lose_next(FaultRig& rig, int count) {
  rig.meddle().outgoing = [left = count](Frames& frames) mutable {
    std::erase_if(frames, [&](const hal::CanFrame& frame) { return is_feedback(frame) && left-- > 0; });
  };
}

void double_all(FaultRig& rig) {
  rig.meddle().outgoing = [](Frames& frames) {
    const Frames given = frames;
    frames.clear();
    for (const hal::CanFrame& frame : given) {
      frames.insert(frames.end(), is_feedback(frame) ? 2 : 1, frame);
    }
  };
}

void reverse_order(FaultRig& rig) {
  rig.meddle().outgoing = [](Frames& frames) { frames = Frames(frames.rbegin(), frames.rend()); };
}

/// Each feedback of the drive comes `periods` cycles after its SYNC.
void delay(FaultRig& rig, std::size_t periods) {
  rig.meddle().outgoing = [periods, held = Frames()](Frames& frames) mutable {
    for (hal::CanFrame& frame : frames) {
      if (is_feedback(frame)) {
        held.push_back(frame);
        if (held.size() > periods) {
          frame = held.front();
          held.erase(held.begin());
        } else {
          frame.id = 0x7FE;  // nobody's
        }
      }
    }
    std::erase_if(frames, [](const hal::CanFrame& frame) { return frame.id == 0x7FE; });
  };
}

/// The kernel's gateway puts something else in the place of the drive's feedback.
void rewrite(FaultRig& rig, const std::string& change) {
  rig.tool(gateway_rule("-D", false, {"-f", "183:7FF"}));
  rig.tool(gateway_rule("-A", false, {"-f", "183:7FF", "-m", change}));
}
void rewrite_no_more(FaultRig& rig, const std::string& change) {
  rig.tool(gateway_rule("-D", false, {"-f", "183:7FF", "-m", change}));
  rig.tool(gateway_rule("-A", false, {"-f", "183:7FF"}));
}

/// Operation Enabled, at the place where the wheel is now and for ever.
std::string stuck_change(FaultRig& rig) {
  const auto position = static_cast<std::uint32_t>(rig.drive(kVictim).motion().position());
  return format("SET:D:183.6.3712%02X%02X%02X%02X0000", position & 0xFF, position >> 8 & 0xFF, position >> 16 & 0xFF,
                position >> 24);
}

void blocked(FaultRig& rig, bool on) {
  (void)rig.drive(kVictim).script().events.push_back({.at = rig.now(), .fault = drivers::SimFault::kBlocked, .on = on});
}

/// Adds to the position in a feedback.
void advance(hal::CanFrame& feedback, std::int32_t counts) {
  auto position = static_cast<std::uint32_t>(counts);
  for (std::size_t i = 0; i < 4; ++i) {
    position += std::uint32_t{feedback.data[2 + i]} << (8 * i);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    feedback.data[2 + i] = static_cast<std::uint8_t>(position >> (8 * i));
  }
}

/// The wheels seem to turn by so much more than they do, mm/s forward.
void slip(FaultRig& rig, const std::array<double, kWheels>& mmps) {
  std::array<double, kWheels> counts{};  // in a cycle
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const DriveParameters& drive = rig.robot().drives[i];
    const double turns_per_s = mmps[i] * 1e-3 / rig.robot().base.wheel_radius_m / 6.283185307179586;
    counts[i] = turns_per_s * drive.sign * drive.gear_ratio * drive.counts_per_turn * seconds(rig.robot().cycle);
  }
  rig.meddle().outgoing = [counts, drift = std::array<double, kWheels>{}](Frames& frames) mutable {
    for (hal::CanFrame& frame : frames) {
      for (std::size_t i = 0; i < counts.size(); ++i) {
        if (frame.id == drivers::cob_id::tpdo1(static_cast<std::uint8_t>(i + 1)) && frame.size == 6) {
          drift[i] += counts[i];
          advance(frame, static_cast<std::int32_t>(drift[i]));
        }
      }
    }
  };
}

void send_what_is_no_data_frame(FaultRig& rig) {
  rig.each_cycle([](FaultRig& each) {
    for (const std::uint16_t id : std::array<std::uint16_t, 6>{0x000, 0x080, 0x083, 0x183, 0x583, 0x703}) {
      each.injector().send_remote(id, 6);
      each.injector().send(id | CAN_EFF_FLAG, {0x08, 0, 0, 0, 0, 0});
      each.injector().send_fd(id, {0x08, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    }
  });
}

}  // namespace

std::vector<FaultRow> faults_of_feedback() {
  const auto change = std::make_shared<std::string>();
  return {
      {.number = 8,
       .name = "four feedbacks of a drive in a row are lost, once",
       .by = "4 of 183h dropped",
       .outcome = Outcome::kGoesOn,
       .says = "no fault",
       .provoke = [](FaultRig& rig) { lose_next(rig, 4); }},
      {.number = 8,
       .name = "a third of a drive's feedback is lost",
       .by = "every third 183h dropped",
       .says = "drive 3 (rear left): feedback comes missing or double too often (* of 100)",
       .detected_within = 200ms,
       .provoke = [](FaultRig& rig) { lose(rig, 3); },
       .mend = no_meddling},
      {.number = 8,
       .name = "a drive's feedback comes a cycle late",
       .by = "each 183h held for a cycle",
       .outcome = Outcome::kGoesOn,
       .says = "no fault",
       .provoke = [](FaultRig& rig) { delay(rig, 1); }},
      {.number = 8,
       .name = "a drive's feedback comes twice",
       .by = "each 183h sent twice",
       .says = "drive 3 (rear left): feedback comes missing or double too often (* of 100)",
       .detected_within = 200ms,
       .provoke = double_all,
       .mend = no_meddling},
      {.number = 8,
       .name = "feedback comes in another order",
       .by = "TPDOs in reverse order",
       .outcome = Outcome::kGoesOn,
       .says = "no fault",
       .provoke = reverse_order},
      {.number = 10,
       .name = "a drive's position stays while it moves",
       .by = "cangw rewrites 183h",
       .says = "drive 3 (rear left): told to turn, but its position stays: encoder, coupling or a blocked wheel",
       .detected_within = 500ms,
       .provoke =
           [change](FaultRig& rig) {
             *change = stuck_change(rig);
             rewrite(rig, *change);
           },
       .mend = [change](FaultRig& rig) { rewrite_no_more(rig, *change); },
       .gateway = true},
      {.number = 10,
       .name = "a wheel is blocked",
       .by = "wheel of drive 3 does not turn",
       .says = "drive 3 (rear left): told to turn, but its position stays: encoder, coupling or a blocked wheel",
       .detected_within = 500ms,
       .provoke = [](FaultRig& rig) { blocked(rig, true); },
       .mend = [](FaultRig& rig) { blocked(rig, false); }},
      {.number = 15,
       .name = "a drive's feedback is a byte short",
       .by = "cangw cuts 183h to 5 bytes",
       .says = "drive 3 (rear left): feedback lost: TPDO1 does not arrive",
       .detected_within = rates::kFeedbackTimeout + kAtOnce,
       .provoke = [](FaultRig& rig) { rewrite(rig, "SET:L:183.5.0000000000000000"); },
       .mend = [](FaultRig& rig) { rewrite_no_more(rig, "SET:L:183.5.0000000000000000"); },
       .gateway = true},
      {.number = 15,
       .name = "an emergency of three bytes",
       .by = "083h with DLC 3 by a third socket",
       .says = "drive 3 (rear left): emergency of a wrong length",
       .detected_within = kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             rig.injector().send(drivers::cob_id::emcy(3), {0x10, 0x23, 0x03});
           }},
      {.number = 15,
       .name = "remote, extended and FD frames with our COB-IDs",
       .by = "18 frames a cycle by a third socket",
       .outcome = Outcome::kGoesOn,
       .says = "no fault",
       .provoke = send_what_is_no_data_frame},
      {.number = 27,
       .name = "all wheels slip by 0.12 m/s, as no body can move",
       .by = "positions in 181h to 184h run ahead",
       .says = "wheels slip: * mm/s that no motion of the base explains",
       .detected_within = 1s,  // the end of a ramp explains some of it

       .provoke =
           [](FaultRig& rig) {
             slip(rig, {120.0, 120.0, -120.0, -120.0});
           },
       .mend = no_meddling},
      {.number = 27,
       .name = "one wheel turns 0.3 m/s faster than told",
       .by = "positions in 183h run ahead",
       .says =
           "drive 3 (rear left): turns * mm/s otherwise than told: blocked, driven from outside, or a slipping belt",
       .detected_within = 500ms,
       .provoke =
           [](FaultRig& rig) {
             slip(rig, {0.0, 0.0, 300.0, 0.0});
           },
       .mend = no_meddling},
  };
}

}  // namespace ivo::firmware::bench
