// Start-up of one drive: reset, boot-up, the steps of startup_steps.hpp, and NMT start when all four are ready.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/pdo_layout.hpp"
#include "drivers/canopen/sdo_client.hpp"
#include "drivers/cia402/mode.hpp"
#include "drivers/drive_fault.hpp"
#include "drivers/pdo_search.hpp"
#include "drivers/startup_steps.hpp"

namespace ivo::drivers {

/// 1018h, as the drive says it; 0 where it does not.
struct DriveIdentity {
  std::uint32_t vendor_id = 0;
  std::uint32_t product_code = 0;
  std::uint32_t revision = 0;
  std::uint32_t serial_number = 0;
};

/// Nothing waits: each cycle on_boot_up, on_heartbeat and on_sdo for what arrived, update, and next_frame, which gives
/// at most one frame. Without a boot-up message (a node that was up and keeps quiet about its reset) it goes on after
/// rates::kBootTimeout: the first SDO answer then counts. A node that boots again before NMT start is configured anew,
/// kRestarts times: some boot twice, and one that was just booting when it was reset does.
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
  static constexpr int kRestarts = 2;

  DriveStartup(const Robot& robot, Wheel wheel) noexcept;

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
  /// Voltage off was written and confirmed since open.
  [[nodiscard]] bool stopped() const noexcept { return stopped_; }
  /// The same, or start-up failed and no more can be said to the drive.
  [[nodiscard]] bool stopped_or_failed() const noexcept { return stopped_ || phase_ == Phase::kFailed; }
  /// True while exactly one answer of the node is on its way.
  [[nodiscard]] bool awaiting_answer() const noexcept;

  /// By which COB-IDs the drive is commanded and answers; from kConfigured on. As standard_channels, unless the drive
  /// could not be mapped so and another of its PDOs does.
  [[nodiscard]] const PdoChannels& channels() const noexcept { return channels_; }
  /// From kConfigured on.
  [[nodiscard]] const DriveIdentity& identity() const noexcept { return identity_; }
  [[nodiscard]] cia402::Mode mode() const noexcept { return mode_; }
  /// The step under way, for people to see; "" outside of kConfiguring. Static.
  [[nodiscard]] const char* step_name() const noexcept;

 private:
  void configure() noexcept;
  void next_step() noexcept;
  void begin_step() noexcept;
  void transfer(const StartupStep& step) noexcept;
  void judge_answer(Instant now) noexcept;
  void judge_abort() noexcept;
  void judge_value(Instant now) noexcept;
  void disable_pdo(std::uint32_t cob_id) noexcept;
  void keep(std::uint32_t value) noexcept;
  void refuse(DriveFaultReason reason, std::uint32_t code) noexcept;
  void follow_search() noexcept;
  void fail(DriveFaultReason reason, const char* step, std::uint32_t code) noexcept;
  [[nodiscard]] const StartupStep& step() const noexcept { return steps_[step_]; }
  [[nodiscard]] bool left_out(const StartupStep& step) const noexcept;
  [[nodiscard]] bool forgiven(SdoAbort code) const noexcept;

  std::uint8_t node_id_;
  Wheel wheel_;
  StartupSteps steps_;
  PdoChannels standard_channels_;
  SdoClient sdo_;
  Phase phase_ = Phase::kClosed;
  std::size_t step_ = 0;
  bool second_try_ = false;  // of the step: its alternative, or the write after the read of a PDO's COB-ID
  bool searching_ = false;   // a PDO, instead of the steps of the present role
  PdoSearch search_;
  DriveFault refused_;  // why a PDO is searched
  PdoChannels channels_;
  DriveIdentity identity_;
  cia402::Mode mode_{};
  bool booted_ = false;
  int restarts_ = 0;
  bool stopped_ = false;
  NmtState heard_ = NmtState::kBootUp;
  Instant deadline_{};  // of kBooting and kConfirming
  std::optional<Instant> mode_deadline_;
  DriveFault fault_;
};

}  // namespace ivo::drivers
