// The four wheel drives as one: up together, moving together, stopped together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "drivers/bus_watch.hpp"
#include "drivers/canopen/heartbeat.hpp"
#include "drivers/canopen/pdo_layout.hpp"
#include "drivers/drive_fault.hpp"
#include "drivers/wheel_drive.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::drivers {

enum class GroupState : std::uint8_t {
  kBooting,   ///< also before open()
  kReady,     ///< Operational on the bus, power off
  kEnabling,  ///< power comes up, all four one transition at a time
  kEnabled,   ///< targets go out
  kStopping,  ///< target zero and quick stop, power off when still
  kFault,     ///< latched: target zero and quick stop, power off when still; until reset_fault()
};

/// At the wheel: after gear and sign.
struct WheelTargets {
  std::array<double, kWheels> radps{};
};

struct GroupFeedback {
  GroupState state = GroupState::kBooting;
  std::array<double, kWheels> angle_rad{};  ///< at the wheel, unwrapped, 0 at the first feedback
  std::array<double, kWheels> radps{};      ///< at the wheel, mean over the last 14 ms
  bool fresh = false;                       ///< the TPDO1 of all four for the last SYNC are in
  bool standstill = false;                  ///< fresh, and all wheels at rest (wheel_encoder.hpp)
  /// Nothing that we could still say would stop a wheel sooner: the loop may end.
  /// kBooting: true. kEnabling, kEnabled, kStopping: false. kReady, kFault: every drive whose TPDO1 arrives says that
  /// its power is off (Fault included), and two SYNCs went out since all four were told so: RPDOs act at the next SYNC,
  /// and what a drive sends then may still be from before. In kFault of start-up: each drive has confirmed voltage off
  /// or failed itself. True also when no drive answers and none was ever enabled.
  bool off = true;
  DriveFault fault;  ///< of kFault; the first one found, and who still turns when the quick stop has had its time
};

/// Each cycle, in this order: on_frame for every frame received, update, write. Nothing waits, allocates or throws.
///
/// Motion is earned: enable must have been false once since open(), stop() or a fault before true counts, and targets
/// other than zero go out only while all four are Operation Enabled. Any drive's fault, emergency, reboot, silence,
/// erratic feedback, twin or unasked change of state latches kFault for all four in the same update, and write then
/// carries the stop. So do a lost or flooded bus, lost frames, another master, a frame of ours that the bus refuses,
/// and kUnsentWrites writes in a row that it did not take whole. Being powered in kReady is forgiven for
/// rates::kUnaskedPowerTimeout. A drive whose TPDO1 does not come may have lost SYNC, and then no RPDO acts on it: in
/// kFault it is told to leave NMT state Operational too, which makes it stop by 6007h. So is one that still has power
/// when quick stop and voltage off had their time, and then our heartbeat ends as well.
class DriveGroup {
 public:
  /// `bus` outlives this. Silent until open().
  DriveGroup(hal::CanBus& bus, const Robot& robot) noexcept;

  /// Begins start-up of all four at once. From kBooting it goes to kReady, or to kFault with the step that failed.
  void open(Instant now) noexcept;
  /// Takes what concerns a drive or comes from another master, leaves the rest.
  void on_frame(const hal::ReceivedFrame& received) noexcept;
  /// Valid until the next call.
  const GroupFeedback& update(Instant now) noexcept;
  /// What update() returned last, with what fail() has made of it since.
  [[nodiscard]] const GroupFeedback& feedback() const noexcept { return feedback_; }
  /// Sends at most kFramesPerWrite frames in one CanBus::send: start-up, SYNC, the commands (pdo_layout.hpp), which the
  /// drives act on at the next SYNC, and last our heartbeat, which a full queue does not take. None is sent after a
  /// write that the bus did not take whole, so drives that we do not reach stop by themselves; nor before each drive
  /// has confirmed, since open(), that its voltage is off: one that turned for a dead master, or missed its NMT reset,
  /// must not be kept going by ours. Without `enable` no frame goes out that could move a wheel: moving wheels get a
  /// quick stop, so a gentle stop is ramped down by the targets first; wheels at rest get shutdown.
  void write(Instant now, bool enable, const WheelTargets& targets) noexcept;
  /// Quick stop, power off when still: kStopping, then kReady. Idempotent; without effect in kBooting, kReady, kFault
  /// save that enable must have been false before it counts again.
  void stop(Instant now) noexcept;
  /// In kFault: with the next update, resets the drives in fault, or starts all four up again where a drive must be
  /// told everything anew. Ends in kReady, or in kFault.
  /// After rates::kResetLimit resets within rates::kResetWindow it stays there, and says so.
  void reset_fault() noexcept;
  /// A fault that somebody else found, as an emergency stop: latched as one of the group's own, so that the next write
  /// carries the stop. One of a wheel is given its node-id here. In kFault without effect: the first one stays.
  void fail(const DriveFault& fault, Instant now) noexcept;

  /// Answers that are on their way (boot-up, SDO, Operational), those to SYNC not counted: for lock-step time.
  [[nodiscard]] int answers_awaited() const noexcept;
  [[nodiscard]] bool awaiting_answer() const noexcept { return answers_awaited() > 0; }
  /// One of the four, to look at.
  [[nodiscard]] const WheelDrive& drive(Wheel wheel) const noexcept { return drives_[static_cast<std::size_t>(wheel)]; }
  /// Frames of a drive with a wrong length; an emergency counts all the same, no other is looked at.
  [[nodiscard]] std::uint64_t malformed() const noexcept;

  static constexpr int kUnsentWrites = 5;
  static constexpr std::size_t kFramesPerWrite = 1 + kWheels + 1 + CommandFrames::capacity();

 private:
  void collect() noexcept;
  template <class Condition>
  void latch_first(DriveFaultReason reason, const Condition& at_fault) noexcept;
  void find_fault(Instant now) noexcept;
  [[nodiscard]] DriveFault first_fault() const noexcept;
  void enter_fault(const DriveFault& fault, Instant now) noexcept;
  [[nodiscard]] bool may_reset(Instant now) noexcept;

  void watch_unasked_power(Instant now) noexcept;
  void update_booting(Instant now) noexcept;
  void update_enabling(Instant now) noexcept;
  void update_stopping(Instant now) noexcept;
  void update_fault(Instant now) noexcept;
  void judge_quick_stop(Instant now) noexcept;
  void update_resetting(Instant now) noexcept;

  void follow(Instant now, bool enable) noexcept;
  void send(std::span<const hal::CanFrame> frames, Instant now) noexcept;
  void begin_stop(Instant now) noexcept;
  void begin_quick_stop(Instant now) noexcept {
    quick_stop_since_ = now;
    quick_stop_judged_ = false;
  }
  void enter(GroupState state, Instant now) noexcept;
  [[nodiscard]] std::uint16_t controlword_for(const WheelDrive& drive, Instant now) const noexcept;
  [[nodiscard]] std::uint16_t off_word(const WheelDrive& drive) const noexcept;
  [[nodiscard]] bool may_say_alive(Instant now) noexcept;
  [[nodiscard]] bool disobeys(const WheelDrive& drive, Instant now) const noexcept;
  [[nodiscard]] bool quick_stop_over(Instant now) const noexcept;
  [[nodiscard]] bool all_off() const noexcept;
  [[nodiscard]] bool may_end(Instant now) const noexcept;

  hal::CanBus& bus_;
  std::array<WheelDrive, kWheels> drives_;
  BusWatch watch_;
  HeartbeatProducer heartbeat_{rates::kMasterHeartbeat};
  HeartbeatProducer last_word_{rates::kMasterHeartbeat};  // NMT to drives that do not answer, in kFault
  std::uint8_t master_node_id_;
  PdoLayout layout_;
  ControlwordSchedule controlwords_;
  GroupFeedback feedback_;
  GroupState state_ = GroupState::kBooting;
  Instant since_{};                       // when state_, or the present step of kEnabling or of a reset, was entered
  Instant quick_stop_since_{};            // when the present quick stop began
  bool quick_stop_judged_ = true;         // the wheels came to rest, or it has had its time
  cia402::PowerState step_{};             // of kEnabling: the state that all four are to reach next
  bool synchronous_ = false;              // all four are Operational: SYNC and RPDO1 go out
  bool enable_was_false_ = false;         // since open, stop or fault
  bool voltage_off_ = true;               // kStopping ends and kReady rests with the voltage disabled, else by shutdown
  bool was_enabled_ = false;              // or was about to be, since construction
  bool told_off_ = false;                 // the last four RPDO1 that went out told all to be off
  int syncs_since_off_ = 0;               // SYNCs that went out after such, in a row
  int unsent_writes_ = 0;                 // in a row, not taken whole by the bus
  std::optional<Instant> powered_since_;  // in kReady, unasked
  bool disobeyed_ = false;                // since open(), a drive kept its power in kFault: our heartbeat ends
  std::uint64_t dropped_before_ = 0;      // by the bus
  bool reset_asked_ = false;
  std::array<std::optional<Instant>, rates::kResetLimit> resets_;  // the last ones, a ring
  std::size_t next_reset_ = 0;
  bool resetting_ = false;  // in kFault: the drives' fault reset is under way
};

}  // namespace ivo::drivers
