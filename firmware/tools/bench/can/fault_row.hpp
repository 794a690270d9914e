// A fault, how it is provoked and what must come of it: a row of the fault table.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "config/base/time.hpp"
#include "config/rates.hpp"
#include "firmware/tools/bench/can/fault_rig.hpp"

namespace ivo::firmware::bench {

enum class Outcome : std::uint8_t {
  kStops,     ///< latched; all four stop; nothing moves until it is cleared and somebody agrees anew
  kGoesOn,    ///< harmless or repaired: the robot drives on, and nothing is latched
  kNoStart,   ///< spoilt before power-on: start-up says what is wrong, nothing ever moves
  kStopsBus,  ///< as kStops, but nobody can be told: the drives stop because our heartbeat is missing
};

struct FaultFigures;

struct FaultRow {
  int number = 0;    ///< 1 to 28: of the list of bus faults
  std::string name;  ///< what happens; of the rows of one number each its own
  std::string by;    ///< what provokes it, in a few words
  Outcome outcome = Outcome::kStops;
  std::string says;            ///< describe(status.drive_fault), whole; empty with kGoesOn
  Duration detected_within{};  ///< of simulated time, from the provocation; not for kGoesOn and kNoStart
  std::function<void(FaultRig&)> provoke;
  std::function<void(FaultRig&)>
      mend{};                 ///< what a person does before the fault is cleared; none: it is over by itself
  bool recovers = true;       ///< moves again once mended, cleared and agreed to
  bool loses_frames = false;  ///< on the way in, and they are to be counted
  bool gateway = false;       ///< with cangw between loop and drives
  bool also_at_1khz = false;  ///< a second row: the shared layout at 1 kHz
  PdoLayout layout = PdoLayout::kOwn;
  int receive_bytes = 0;                            ///< of the loop's queue of arrivals; 0: as always
  std::function<bool(FaultRig&)> detected{};        ///< instead of the loop's mode being fault
  Duration rest_within{};                           ///< from the provocation, instead of the quick stop's ramp; 0: that
  std::function<Result<FaultFigures>()> instead{};  ///< tried in this way, of its own
  std::string skip{};                               ///< why it is not provoked here; empty: it is
};

/// What most rows do something to.
inline constexpr Wheel kVictim = Wheel::kRearLeft;
[[nodiscard]] inline drivers::SimScript& victim(FaultRig& rig) { return rig.drive(kVictim).script(); }
inline void no_meddling(FaultRig& rig) { rig.meddle().outgoing = nullptr; }

/// How soon the loop sees what it needs no patience for.
inline constexpr Duration kAtOnce = 2 * rates::kCycle;

/// Every row, by number.
[[nodiscard]] std::vector<FaultRow> fault_rows();

[[nodiscard]] std::vector<FaultRow> faults_of_drives();
[[nodiscard]] std::vector<FaultRow> faults_of_feedback();
[[nodiscard]] std::vector<FaultRow> faults_of_bus();
[[nodiscard]] std::vector<FaultRow> faults_of_others();
[[nodiscard]] std::vector<FaultRow> faults_at_start();
[[nodiscard]] std::vector<FaultRow> faults_of_loop();
[[nodiscard]] std::vector<FaultRow> faults_of_inputs();

}  // namespace ivo::firmware::bench
