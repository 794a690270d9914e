// What a master of this robot's wheels may do, said once more and apart from the product: looks at every frame that
// leaves and every frame that arrives, and knows nothing else but what the operator sees and says.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "config/robot.hpp"
#include "firmware/safety/mode.hpp"
#include "hal/api/can_bus.hpp"
#include "tests/support/shadow_frames.hpp"

namespace ivo::test {

class ShadowModel {
 public:
  using Mode = firmware::Mode;

  /// What happened apart from frames, at the beginning of a cycle.
  struct Outside {
    Instant now{};
    std::int64_t skipped = 0;
    bool consent = false;  ///< to what is shown, by somebody who knows of every pause so far
    bool watched = false;  ///< of it: it counts only while beats come
    bool pause = false;    ///< asked for, also by whoever wants another plan
    bool beat = false;
    bool clear = false;
    bool bus_lost = false;
    std::uint64_t receive_dropped = 0;  ///< in all
    bool stop_input = false;            ///< emergency stop or bumper pressed, tapped since the last cycle, or not read
    bool wheels_turn = false;           ///< in truth
    bool moved_by_others = false;       ///< another master commanded the drives since the last fault
  };

  explicit ShadowModel(const Robot& robot) : robot_(robot) {}

  void begin(const Outside& outside) {
    armed_ = sync_sent_ && mode_ != Mode::kFault && mode_ != Mode::kDone;
    now_ = outside.now;
    certain_.clear();
    sync_sent_ = false;
    unsent_ = std::exchange(wrote_, false) ? unsent_ : 0;  // nothing to say is nothing unsaid
    if (outside.clear && mode_ == Mode::kFault) {
      cleared_ = true;
      last_clear_ = now_;
    }
    look_at_operator(outside);
    look_outside(outside);
    look_at_wheels(outside);
  }

  void received(const hal::CanFrame& frame) {
    const int node = frame.id & 0x7F;
    const int function = frame.id & 0x780;
    if (frame.id == 0x000 || frame.id == 0x080 || frame.id == 0x700 + robot_.master_node_id) {
      certain("another master");
    }
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      if (robot_.drives[i].node_id != node) {
        continue;
      }
      if (function == 0x600 || shadow::is_rpdo(function)) {
        certain("another master");
      } else if (function == 0x080 && (frame.size != 8 || frame.data[0] != 0 || frame.data[1] != 0)) {
        certain("emergency");
      } else if (const int number = shadow::tpdo_number(function); number > 0 && frame.size == 6) {
        drives_[i].heard_now[static_cast<std::size_t>(number)] = true;
        if (number == drives_[i].feedback) {
          drives_[i].statusword = shadow::word_in(frame);
          drives_[i].feedback_at = now_;
        }
      } else if (function == 0x700 && frame.size == 1) {
        hear_heartbeat(drives_[i], frame.data[0] & 0x7F);
      }
    }
  }

  void sent(std::span<const hal::CanFrame> frames, std::size_t taken) {
    check_certain_states();
    Batch batch;
    for (const hal::CanFrame& frame : frames) {
      look_at(frame, batch);
    }
    for (const Drive& drive : drives_) {  // a word that is not said again is as it was
      batch.enabling += batch.commands > 0 && drive.told_to_run() ? 1 : 0;
      batch.targets += batch.commands > 0 && drive.target != 0 ? 1 : 0;
      expect(batch.commands == 0 || drive.target == 0 || drive.told_to_run(), "a target without power");
    }
    judge(batch);
    unsent_ = batch.orders > 0 && batch.syncs == 0 ? 0 : unsent_;  // start-up anew
    const bool whole = taken == frames.size();
    expect(!batch.heartbeat || unsent_ == 0, "heartbeat though the last commands did not get out");
    expect(!batch.heartbeat || batch.heartbeat_last, "heartbeat before the commands");
    unsent_ = whole ? 0 : unsent_ + 1;
    wrote_ = true;
    frames_ += frames.size();
    sync_sent_ = batch.syncs > 0;
    moving_before_ = batch.targets > 0;
  }

  void end(Mode shown) {
    const bool stopped = shown == Mode::kFault || shown == Mode::kDone;
    for (const std::string& event : certain_) {
      expect(stopped, "not found at once: " + event);
    }
    if (stopped && mode_ != shown) {
      consented_ = false;
      paused_at_.reset();
      cleared_ = false;
      stopped_at_ = now_;
      ++faults_;
    }
    mode_ = shown;
  }

  [[nodiscard]] const std::map<std::string, int>& violations() const { return violations_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] int faults() const { return faults_; }
  [[nodiscard]] int starts() const { return starts_; }
  /// In motion, because it was asked for or because no beat came.
  [[nodiscard]] int pauses() const { return pauses_; }
  [[nodiscard]] int beats_lost() const { return beats_lost_; }
  [[nodiscard]] std::uint64_t certain_events() const { return certain_events_; }

 private:
  using Drive = ShadowDrive;
  using Batch = ShadowBatch;

  void expect(bool holds, const std::string& rule) {
    if (!holds) {
      ++violations_[rule];
    }
  }
  void certain(const char* event) {
    if (armed_) {
      certain_.emplace_back(event);
      ++certain_events_;
    }
  }

  void hear_heartbeat(Drive& drive, int state) {
    if (state == 0x00) {
      certain("reboot");
    } else if (state == 0x04 || state == 0x05 || state == 0x7F) {
      drive.left_operational = state != 0x05;
      if (armed_) {
        drive.heartbeat_at = now_;
      }
    }
  }

  // Who agrees before a pause, or in its cycle, has not agreed to go on after it.
  void look_at_operator(const Outside& outside) {
    if (outside.consent && !outside.pause && mode_ == Mode::kAwaitingConsent && cleared_) {
      consented_ = true;
      watched_ = outside.watched;
      beat_at_ = now_;
      paused_at_.reset();
    }
    if (outside.beat) {
      beat_at_ = now_;
    }
    const bool beat_lost = watched_ && mode_ == Mode::kSearching && now_ - beat_at_ > robot_.loop.beat_timeout;
    if (!outside.pause && !beat_lost) {
      return;
    }
    if (mode_ != Mode::kSearching) {
      consented_ = consented_ && in_motion();  // as long as it ramps down
    } else if (!paused_at_) {
      paused_at_ = now_;
      ++pauses_;
      beats_lost_ += outside.pause ? 0 : 1;
    }
  }

  void look_outside(const Outside& outside) {
    if (outside.bus_lost) {
      certain("bus lost");
    }
    if (outside.receive_dropped != dropped_) {
      certain("frames lost");
    }
    dropped_ = outside.receive_dropped;
    stop_input_ = outside.stop_input;
    if (stop_input_ && in_motion()) {
      certain("stop input");
    }
    if (outside.skipped >= 5 && in_motion()) {
      certain("late");
    }
    if (unsent_ >= 5) {
      certain("commands not sent");
    }
  }

  // More than any ramp of these drives takes after they have missed our heartbeat.
  void look_at_wheels(const Outside& outside) {
    if (outside.wheels_turn && stopped_at_ && !consented_ && !outside.moved_by_others) {
      expect(now_ - *stopped_at_ < shadow::ms(700), "wheels turn long after a fault or pause");
    }
  }

  void check_certain_states() {
    for (Drive& drive : drives_) {
      drive.choose_feedback();
      if (!armed_) {
        drive.statusword = 0;
        drive.feedback_at = now_;
        drive.heartbeat_at.reset();
      }
      if (drive.faulty()) {
        certain("drive in fault");
      }
      if (moving_before_ && !drive.enabled()) {
        certain("drive left Operation Enabled");
      }
      if (drive.left_operational) {
        certain("drive left Operational");
      }
      drive.left_operational = false;
      if (now_ - drive.feedback_at.value_or(now_) > shadow::ms(14)) {
        certain("no feedback");
      }
      if (now_ - drive.heartbeat_at.value_or(now_) > shadow::ms(156)) {
        certain("no heartbeat");
      }
    }
  }

  void look_at(const hal::CanFrame& frame, Batch& batch) {
    batch.heartbeat_last = !batch.heartbeat;
    if (frame.id == 0x080) {
      ++batch.syncs;
    } else if (frame.id == 0x000) {
      ++batch.orders;
    } else if (frame.id == 0x700 + robot_.master_node_id) {
      batch.heartbeat = true;
    } else {
      for (std::size_t i = 0; i < drives_.size(); ++i) {
        const int node = robot_.drives[i].node_id;
        if (frame.id == 0x600 + node) {
          ++batch.requests;
          look_at_request(frame);
        } else if ((frame.id & 0x7F) == node && shadow::is_rpdo(frame.id & 0x780)) {
          batch.sync_first = batch.sync_first && batch.syncs == 1;
          if (robot_.pdo_layout == PdoLayout::kShared) {
            look_at_shared(frame, i, batch);
          } else {
            look_at_word(shadow::word_in(frame), drives_[i]);
            look_at_target(shadow::target_in(frame, 2), i, batch);
          }
        }
      }
    }
  }

  void look_at_request(const hal::CanFrame& frame) {
    const bool writes = (frame.data[0] & 0xE0) == 0x20;
    const int object = frame.data[1] | frame.data[2] << 8;
    const bool zero =
        std::all_of(frame.data.begin() + 4, frame.data.end(), [](std::uint8_t byte) { return byte == 0; });
    expect(!writes || zero || (object != 0x6040 && object != 0x60FF), "motion by SDO");
  }

  /// RPDO1 {6040h}; RPDO2 of the front left and of the rear left drive {60FFh, 60FFh}: of it and of the right one.
  void look_at_shared(const hal::CanFrame& frame, std::size_t i, Batch& batch) {
    if ((frame.id & 0x780) == 0x200 && frame.size == 2) {
      look_at_word(shadow::word_in(frame), drives_[i]);
    } else if ((frame.id & 0x780) == 0x300 && frame.size == 8 && i % 2 == 0) {
      look_at_target(shadow::target_in(frame, 0), i, batch);
      look_at_target(shadow::target_in(frame, 4), i + 1, batch);
    } else {
      expect(false, "a frame of no layout");
    }
  }

  void look_at_word(std::uint16_t word, Drive& drive) {
    if ((word & 0x80) != 0 && (drive.word & 0x80) == 0) {
      expect(last_clear_ && now_ - *last_clear_ <= shadow::ms(5000), "a fault reset that nobody asked for");
    }
    drive.word = word;
  }

  void look_at_target(std::int32_t target, std::size_t i, Batch& batch) {
    Drive& drive = drives_[i];
    ++batch.commands;
    const DriveParameters& parameters = robot_.drives[i];
    const double rim = target / (parameters.velocity_per_radps * parameters.gear_ratio) * robot_.base.wheel_radius_m;
    const double step = std::abs(rim) - std::abs(drive.rim_mps);
    const double cycles_s = 2.0 * seconds(robot_.cycle);  // of a late one no more
    expect(std::abs(rim) <= 1.001 * rim_of(kSearchSpeed_mps, robot_.limits.max_turn_radps), "faster than the search");
    expect(step <= 1.5 * cycles_s * rim_of(robot_.limits.max_accel_mps2, robot_.limits.max_turn_accel_radps2),
           "a jump of the target");
    drive.target = target;
    drive.rim_mps = rim;
  }

  /// The fastest wheel of a mecanum base, whatever the direction; of accelerations alike.
  [[nodiscard]] double rim_of(double along, double turn) const {
    return std::sqrt(2.0) * along + (robot_.base.half_length_m + robot_.base.half_width_m) * turn;
  }

  void judge(const Batch& batch) {
    const bool moving = batch.enabling > 0 || batch.targets > 0;
    const auto enabled = [](const Drive& drive) { return drive.enabled(); };
    const bool all_enabled = std::all_of(drives_.begin(), drives_.end(), enabled);
    judge_pause(moving, batch);
    expect(!moving || consented_, "motion without consent since the last fault or pause");
    expect(!moving || certain_.empty(), "motion in the cycle of a fault");
    expect(!moving || !stop_input_, "motion while a stop input is pressed");
    expect(batch.enabling == 0 || batch.enabling == kWheels, "power for some of four");
    expect(batch.targets == 0 || all_enabled, "a target before all four hold speed");
    expect(batch.commands == 0 || batch.commands == kWheels, "commands for some of four");
    expect(batch.commands == 0 || (batch.syncs == 1 && batch.sync_first), "commands without SYNC before them");
    expect(batch.syncs == 0 || batch.commands == kWheels, "SYNC without commands");
    expect(batch.requests == 0 || !moving, "SDO while the robot moves");
    expect(batch.orders == 0 || !moving, "NMT while the robot moves");
    starts_ += batch.targets > 0 && !moving_before_ ? 1 : 0;
  }

  // A ramp from full speed takes 0.7 s; late cycles, which are held, draw it out.
  void judge_pause(bool moving, const Batch& batch) {
    const double speed_mps = speed();
    if (paused_at_ && consented_ && batch.commands > 0) {
      expect(speed_mps <= speed_mps_ + kRounding_mps, "faster in a pause");
      expect(batch.targets == 0 || now_ - *paused_at_ < shadow::ms(1200), "motion long after a pause");
      if (!moving) {  // once it stands somebody must agree anew
        consented_ = false;
        stopped_at_ = now_;
      }
    }
    speed_mps_ = batch.commands > 0 ? speed_mps : speed_mps_;
  }

  /// Of the base along the ground, as told: mecanum kinematics over FL, FR, RL, RR.
  [[nodiscard]] double speed() const {
    constexpr std::array<int, kWheels> kSideways{-1, 1, 1, -1};
    double along = 0.0;
    double sideways = 0.0;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      const double rim_mps = drives_[i].rim_mps * robot_.drives[i].sign;
      along += rim_mps / kWheels;
      sideways += kSideways[i] * rim_mps / kWheels;
    }
    return std::hypot(along, sideways);
  }

  [[nodiscard]] bool in_motion() const {
    return mode_ == Mode::kSearching || mode_ == Mode::kStopping || mode_ == Mode::kPausing;
  }

  static constexpr double kSearchSpeed_mps = 0.5;
  static constexpr double kRounding_mps = 1e-3;

  Robot robot_;
  std::array<Drive, kWheels> drives_{};
  Mode mode_ = Mode::kPlanning;  // as shown
  Instant now_{};
  bool armed_ = false;  // PDOs run and no fault is shown: what is heard now must be acted on now
  bool sync_sent_ = false;
  bool moving_before_ = false;
  bool cleared_ = true;  // nothing to clear at the beginning
  bool consented_ = false;
  bool watched_ = false;
  Instant beat_at_{};
  std::optional<Instant> paused_at_;  // in motion, and nobody has agreed since
  double speed_mps_ = 0.0;            // told last
  std::optional<Instant> last_clear_;
  std::optional<Instant> stopped_at_;
  bool stop_input_ = false;
  int unsent_ = 0;  // batches in a row that were not taken whole
  bool wrote_ = false;
  std::uint64_t dropped_ = 0;
  std::vector<std::string> certain_;  // faults of this cycle about which there is no doubt
  std::map<std::string, int> violations_;
  std::uint64_t certain_events_ = 0;
  std::uint64_t frames_ = 0;
  int faults_ = 0;
  int starts_ = 0;
  int pauses_ = 0;
  int beats_lost_ = 0;
};

}  // namespace ivo::test
