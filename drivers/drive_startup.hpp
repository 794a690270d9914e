// Start-up of one drive: reset, boot-up, the steps of startup_steps.hpp, and NMT start when all four are ready.
#pragma once

#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/sdo_client.hpp"
#include "drivers/cia402/mode.hpp"
#include "drivers/drive_fault.hpp"
#include "drivers/startup_steps.hpp"

namespace ivo::drivers {

/// Nothing waits: each cycle on_boot_up, on_heartbeat and on_sdo for what arrived, update, and next_frame, which gives
/// at most one frame. Without a boot-up message (a node that was up and keeps quiet about its reset) it goes on after
/// rates::kBootTimeout: the first SDO answer then counts.
class DriveStartup {
 public:
  enum class Phase : std::uint8_t {
    kClosed,
    kResetting,    // reset communication not sent yet
    kBooting,      // boot-up message awaited
    kConfiguring,  // SDO steps
    kConfigured,   // start() is awaited
    kStarting,     // NMT start not sent yet
    kConfirming,   // heartbeat Operational awaited
    kOperational,
    kFailed,
  };

  DriveStartup(const DriveParameters& drive, Wheel wheel, std::uint8_t master_node_id) noexcept;

  void open() noexcept;
  /// Once kConfigured: NMT start.
  void start() noexcept;

  void on_boot_up() noexcept;
  void on_heartbeat(NmtState state) noexcept;
  void on_sdo(const hal::CanFrame& frame) noexcept { sdo_.on_frame(frame); }
  void update(Instant now) noexcept;
  [[nodiscard]] std::optional<hal::CanFrame> next_frame(Instant now) noexcept;

  [[nodiscard]] Phase phase() const noexcept { return phase_; }
  [[nodiscard]] const DriveFault& fault() const noexcept { return fault_; }
  /// Voltage off was written and confirmed since open, or start-up failed and no more can be said to the drive.
  [[nodiscard]] bool stopped_or_failed() const noexcept { return stopped_ || phase_ == Phase::kFailed; }
  /// True while exactly one answer of the node is on its way.
  [[nodiscard]] bool awaiting_answer() const noexcept;

 private:
  void next_step() noexcept;
  void begin_step() noexcept;
  void judge_answer(Instant now) noexcept;
  void judge_failure() noexcept;
  void judge_value(Instant now) noexcept;
  void fail(DriveFaultReason reason, const char* step, std::uint32_t code) noexcept;
  [[nodiscard]] const StartupStep& step() const noexcept { return steps_[step_]; }

  std::uint8_t node_id_;
  Wheel wheel_;
  StartupSteps steps_;
  SdoClient sdo_;
  Phase phase_ = Phase::kClosed;
  std::size_t step_ = 0;
  cia402::Mode mode_{};
  bool booted_ = false;
  bool booted_twice_ = false;
  bool stopped_ = false;
  NmtState heard_ = NmtState::kBootUp;
  Instant deadline_{};  // of kBooting and kConfirming
  std::optional<Instant> mode_deadline_;
  DriveFault fault_;
};

}  // namespace ivo::drivers
