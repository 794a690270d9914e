// One wheel's CiA 402 drive: its start-up, what it says, and whether it is still there.
#pragma once

#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "config/rates.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/emcy.hpp"
#include "drivers/canopen/emcy_history.hpp"
#include "drivers/canopen/heartbeat.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/canopen/pdo_layout.hpp"
#include "drivers/cia402/statusword.hpp"
#include "drivers/drive_fault.hpp"
#include "drivers/drive_startup.hpp"
#include "drivers/feedback_tally.hpp"
#include "drivers/heartbeat_rhythm.hpp"
#include "drivers/wheel_encoder.hpp"

namespace ivo::drivers {

/// Each cycle, in this order: on_frame for what arrived, update, then next_frame and command for what is sent.
class WheelDrive {
 public:
  using Phase = DriveStartup::Phase;

  WheelDrive(const Robot& robot, Wheel wheel) noexcept;

  /// Begins start-up anew; the fault is forgotten, the wheel's angle is kept.
  void open() noexcept;
  /// Once kConfigured: NMT start.
  void start() noexcept { startup_.start(); }
  /// A SYNC goes out now: its TPDO1 is awaited.
  void expect_feedback(Instant now) noexcept;
  /// Forgets a fault that needs no start-up (needs_start_up).
  void clear_fault() noexcept;
  /// Latches a fault found by the group, unless one is latched already.
  void latch(DriveFaultReason reason, std::uint32_t code) noexcept;

  /// A frame that this node sent.
  void on_frame(const hal::ReceivedFrame& received) noexcept;
  void update(Instant now) noexcept;
  /// A frame of start-up to send, at most one a cycle.
  [[nodiscard]] std::optional<hal::CanFrame> next_frame(Instant now) noexcept { return startup_.next_frame(now); }
  /// `radps` at the wheel in the drive's units, rounded, held within its 32 bits; 0 when not a number.
  [[nodiscard]] DriveCommand command(std::uint16_t controlword, double radps) const noexcept;

  [[nodiscard]] std::uint8_t node_id() const noexcept { return node_id_; }
  [[nodiscard]] Phase phase() const noexcept { return startup_.phase(); }
  /// The COB-IDs of its PDOs, once it is configured.
  [[nodiscard]] const PdoChannels& channels() const noexcept { return startup_.channels(); }
  [[nodiscard]] const DriveStartup& startup() const noexcept { return startup_; }
  /// Since construction.
  [[nodiscard]] const EmcyHistory& emergencies() const noexcept { return emergencies_; }
  [[nodiscard]] const DriveFault& fault() const noexcept { return fault_; }
  [[nodiscard]] bool awaiting_answer() const noexcept { return startup_.awaiting_answer(); }
  /// Its TPDO1 came, or was first asked for, within rates::kFeedbackTimeout.
  [[nodiscard]] bool answers(Instant now) const noexcept {
    return last_feedback_.has_value() && now - *last_feedback_ <= rates::kFeedbackTimeout;
  }
  /// Started up, and neither booted nor left Operational since, as far as heard.
  [[nodiscard]] bool operational() const noexcept {
    return startup_.phase() == Phase::kOperational && !left_operational_;
  }
  [[nodiscard]] bool stopped() const noexcept { return startup_.stopped(); }
  [[nodiscard]] bool stopped_or_failed() const noexcept { return startup_.stopped_or_failed(); }
  /// The TPDO1 of the last SYNC is in.
  [[nodiscard]] bool fresh() const noexcept { return fresh_; }
  [[nodiscard]] std::uint16_t statusword() const noexcept { return status_.statusword; }
  [[nodiscard]] cia402::PowerState power_state() const noexcept { return cia402::power_state(status_.statusword); }
  /// Power off and no fault; true before the first feedback.
  [[nodiscard]] bool off() const noexcept;
  /// Switched On or beyond: the wheel may be driven.
  [[nodiscard]] bool powered() const noexcept;
  [[nodiscard]] bool in_fault() const noexcept;
  [[nodiscard]] const WheelEncoder& encoder() const noexcept { return encoder_; }
  /// Frames of ours with a wrong length, not looked at, save that an emergency is one whatever its length.
  [[nodiscard]] std::uint64_t malformed() const noexcept { return malformed_; }

 private:
  struct Heard {  // since the last update
    std::optional<NmtState> heartbeat;
    bool boot_up = false;
    std::optional<Emergency> emergency;
    std::optional<DriveStatus> feedback;
  };

  WheelDrive(const Robot& robot, const DriveParameters& drive, Wheel wheel) noexcept;

  void hear_heartbeat(const hal::ReceivedFrame& received) noexcept;
  void watch(Instant now) noexcept;

  std::uint8_t node_id_;
  int sign_;
  double gear_ratio_;
  double velocity_per_radps_;
  Wheel wheel_;
  DriveStartup startup_;
  WheelEncoder encoder_;
  HeartbeatConsumer heartbeat_{rates::kDriveHeartbeatTimeout};
  HeartbeatRhythm rhythm_{rates::kDriveHeartbeat};
  FeedbackTally tally_;
  Heard heard_;
  DriveStatus status_;
  bool fresh_ = false;
  bool left_operational_ = false;
  std::optional<Instant> sync_;           // the last one
  std::optional<Instant> last_feedback_;  // or the first SYNC
  DriveFault fault_;
  EmcyHistory emergencies_;
  std::uint64_t malformed_ = 0;
};

}  // namespace ivo::drivers
