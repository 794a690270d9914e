#include "firmware/tools/bench/can/fault_trial.hpp"

#include <algorithm>
#include <memory>

#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/drive_fault_text.hpp"

namespace ivo::firmware::bench {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

constexpr Duration kGoesOnFor = 2s;
constexpr Duration kStopLimit = 5s;
constexpr Duration kStartLimit = 30s;
constexpr Duration kWatched = 1s;  // for what moves unasked, after the stop and again after clearing
constexpr Duration kReadyLimit = 30s;
constexpr int kCyclesToAct = 3;  // a command acts with the SYNC of the next cycle, and motion is seen after one more
constexpr int kConsents = 4;

double ms_of(Duration time) { return seconds(time) * 1e3; }

// Stated here and not taken from the drivers: CiA 402-2, enable operation is bits 0 to 3 set, bit 7 clear.
bool moves(const hal::CanFrame& rpdo) {
  const int word = rpdo.data[0] | rpdo.data[1] << 8;
  const bool target = std::any_of(rpdo.data.begin() + 2, rpdo.data.end(), [](std::uint8_t byte) { return byte != 0; });
  return target || (word & 0x8F) == 0x0F;
}

/// RPDO2 of two drives that share their targets.
bool turns(const hal::CanFrame& rpdo) {
  return std::any_of(rpdo.data.begin(), rpdo.data.end(), [](std::uint8_t byte) { return byte != 0; });
}

/// Commands in the last cycle that can move a wheel.
int moving_commands(FaultRig& rig) {
  int moving = 0;
  for (const hal::CanFrame& frame : rig.sent()) {
    for (const DriveParameters& drive : rig.robot().drives) {
      moving += frame.id == drivers::cob_id::rpdo1(drive.node_id) && moves(frame) ? 1 : 0;
      moving += frame.id == drivers::cob_id::rpdo(2, drive.node_id) && turns(frame) ? 1 : 0;
    }
  }
  return moving;
}

/// Drives that were told in the last cycle to stop by quick stop or voltage off; their target is moving_commands'
/// matter.
int drives_told_to_stop(FaultRig& rig) {
  int told = 0;
  for (const DriveParameters& drive : rig.robot().drives) {
    told += std::any_of(rig.sent().begin(), rig.sent().end(),
                        [&](const hal::CanFrame& frame) {
                          const int word = frame.data[0] | frame.data[1] << 8;
                          return frame.id == drivers::cob_id::rpdo1(drive.node_id) && (word == 0x02 || word == 0x00);
                        })
                ? 1
                : 0;
  }
  return told;
}

class Trial {
 public:
  Trial(const FaultRow& row, FaultRig& rig) : row_(row), rig_(rig) {}

  Result<FaultFigures> run() {
    if (row_.outcome == Outcome::kNoStart) {
      row_.provoke(rig_);
      rig_.power_on();
      fail_to_start();
    } else {
      if (!rig_.drive_at_speed()) {
        return Error{"the robot did not come to drive: " + drivers::describe(rig_.status().drive_fault)};
      }
      provoked_ = rig_.now();
      row_.provoke(rig_);
      if (row_.outcome == Outcome::kGoesOn) {
        go_on();
      } else {
        stop();
      }
    }
    figures_.frames_lost = rig_.status().counters.bus.receive_dropped;
    if (!rig_.complaint().empty()) {
      return Error{rig_.complaint()};
    }
    return figures_;
  }

 private:
  [[nodiscard]] double since_provoked_ms() const { return ms_of(rig_.now() - provoked_); }

  /// Until they are told, or miss our heartbeat, the wheels may gather speed.
  [[nodiscard]] double rest_limit_ms() const {
    const Duration told = row_.outcome == Outcome::kStopsBus ? rates::kMasterHeartbeatTimeout + rates::kMasterHeartbeat
                                                             : row_.detected_within;
    if (row_.rest_within > Duration::zero()) {
      return ms_of(row_.rest_within);
    }
    return ms_of(told + kCyclesToAct * rig_.robot().cycle) + fastest_mps_ / rig_.robot().limits.quick_stop_mps2 * 1e3;
  }

  bool detected() { return row_.detected ? row_.detected(rig_) : rig_.status().mode == Mode::kFault; }

  void go_on() {
    const bool stopped = rig_.run_until(
        [this](FaultRig& rig) { return detected() || rig.status().mode != Mode::kSearching || rig.at_rest(); },
        kGoesOnFor);
    figures_.says = drivers::describe(rig_.status().drive_fault);
    figures_.moves_again = !stopped;
  }

  void fail_to_start() {
    const bool failed = rig_.run_until(
        [this](FaultRig& rig) {
          count_unasked();
          return rig.status().mode == Mode::kFault;
        },
        kStartLimit);
    figures_.says = drivers::describe(rig_.status().drive_fault);
    if (failed) {
      wait_and_clear();
    }
  }

  void stop() {
    // Cycles since detection until all four are told to stop, and with the last command that did not stop.
    std::optional<int> told;
    bool all_told = row_.outcome == Outcome::kStopsBus;  // there nobody can be told
    int cycles = 0;
    fastest_mps_ = rig_.rim_speed_mps();
    rig_.run_until(
        [&](FaultRig& rig) {
          fastest_mps_ = std::max(fastest_mps_, rig.rim_speed_mps());
          if (!figures_.detected_ms && detected()) {
            figures_.detected_ms = since_provoked_ms() - ms_of(rig_.robot().cycle);  // the cycle has passed already
          }
          if (figures_.detected_ms) {
            all_told = all_told || drives_told_to_stop(rig) == kWheels;
            told = moving_commands(rig) > 0 || !all_told ? cycles + 1 : told.value_or(0);
            ++cycles;
          }
          if (!figures_.rest_ms && rig.at_rest()) {
            figures_.rest_ms = since_provoked_ms();
          }
          return figures_.detected_ms && figures_.rest_ms;
        },
        kStopLimit + row_.detected_within + row_.rest_within);
    figures_.told_cycles = told;
    figures_.rest_limit_ms = rest_limit_ms();
    figures_.says = drivers::describe(rig_.status().drive_fault);
    if (figures_.detected_ms && figures_.rest_ms) {
      rig_.run(kCyclesToAct * rig_.robot().cycle);
      wait_and_clear();
    }
  }

  void count_unasked() {
    figures_.unasked += moving_commands(rig_);
    figures_.unasked += rig_.at_rest() ? 0 : 1;
  }
  void watch(Duration time) {
    for (const Instant end = rig_.now() + time; rig_.now() < end;) {
      rig_.cycle();
      count_unasked();
    }
  }

  // Consent without clearing counts for nothing, and clearing without consent moves nothing.
  void wait_and_clear() {
    rig_.hold_loop(false);
    for (int i = 0; i < kConsents; ++i) {
      (void)rig_.loop().command(OperatorCommand::kConsent);
      watch(kWatched / kConsents);
    }
    figures_.says = drivers::describe(rig_.status().drive_fault);  // the first one stays
    rig_.each_cycle(nullptr);
    if (row_.mend) {
      row_.mend(rig_);
      watch(kWatched / kConsents);
    }
    const Instant cleared = rig_.now();
    (void)rig_.loop().command(OperatorCommand::kClearFault);
    const bool ready = rig_.run_until(
        [this](FaultRig& rig) {
          count_unasked();
          return rig.status().mode == Mode::kAwaitingConsent;
        },
        row_.recovers ? kReadyLimit : kWatched);
    if (ready) {
      figures_.ready_ms = ms_of(rig_.now() - cleared);
      watch(kWatched);
    }
    figures_.moves_again = rig_.consent_and_move();
  }

  const FaultRow& row_;
  FaultRig& rig_;
  Instant provoked_{};
  double fastest_mps_ = 0.0;  // of a rim, since then
  FaultFigures figures_;
};

}  // namespace

Result<FaultFigures> try_fault(const FaultRow& row) {
  if (row.instead) {
    return row.instead();
  }
  Result<std::unique_ptr<FaultRig>> rig =
      FaultRig::make({.gateway = row.gateway, .layout = row.layout, .receive_bytes = row.receive_bytes});
  if (!rig) {
    return rig.error();
  }
  return Trial(row, *rig.value()).run();
}

}  // namespace ivo::firmware::bench
