// A simulated wheel drive: CANopen node (CiA 301) with velocity drive (CiA 402), made from an EDS.
//
// NMT, boot-up, heartbeat both ways, EMCY with history, SDO server with segments, four RPDOs and four TPDOs as mapped,
// SYNC both ways; power state machine with its option codes, profile and cyclic synchronous velocity with ramps, quick
// stop, halt, fault reaction, reaction to a lost master by 1029h and 6007h; and every fault of sim_fault.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/heartbeat.hpp"
#include "drivers/eds/shipped_eds.hpp"
#include "drivers/sim/object_dictionary.hpp"
#include "drivers/sim/sim_change.hpp"
#include "drivers/sim/sim_emergencies.hpp"
#include "drivers/sim/sim_encoder.hpp"
#include "drivers/sim/sim_heartbeats.hpp"
#include "drivers/sim/sim_motion.hpp"
#include "drivers/sim/sim_pdo.hpp"
#include "drivers/sim/sim_period.hpp"
#include "drivers/sim/sim_power.hpp"
#include "drivers/sim/sim_script.hpp"
#include "drivers/sim/sim_sdo_server.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

/// Time is handed in; the same frames and times in give the same frames out, bit for bit. No heap, nothing waits.
class SimDrive {
 public:
  /// What the drive sends: at most kFramesPerCall for one call below.
  using Outbox = StaticVector<hal::CanFrame, 256>;
  static constexpr std::size_t kFramesPerCall = 24;

  /// `eds` is read here and not kept. Programmer's contract: it is fit (sim_objects.hpp).
  explicit SimDrive(const DriveParameters& drive, const SimScript& script = SimScript(),
                    const EdsDictionary& eds = ivo_drive_eds()) noexcept;

  /// Power on: boot-up message, NMT state Pre-operational.
  void open(Outbox& out) noexcept;
  /// Time goes on to `now`: motion, heartbeats, the script.
  void advance_to(Instant now, Outbox& out) noexcept;
  /// A frame of another node. SYNC applies the last synchronous RPDOs and sends synchronous TPDOs.
  void on_frame(const hal::CanFrame& frame, Outbox& out) noexcept;

  [[nodiscard]] std::uint8_t node_id() const noexcept { return node_id_; }
  [[nodiscard]] Instant now() const noexcept { return now_; }
  [[nodiscard]] std::uint16_t sync_id() const noexcept;  ///< 1005h
  [[nodiscard]] Duration sync_period() const noexcept;   ///< 1006h
  [[nodiscard]] cia402::PowerState power_state() const noexcept { return power_.state(); }
  [[nodiscard]] NmtState nmt_state() const noexcept { return nmt_; }
  [[nodiscard]] const SimMotion& motion() const noexcept { return motion_; }
  /// To change what it does from now on.
  [[nodiscard]] SimScript& script() noexcept { return script_; }
  /// Changes since the last call of forget_changes(), the first kChanges of them.
  [[nodiscard]] std::span<const SimChange> changes() const noexcept { return changes_.span(); }
  void forget_changes() noexcept { changes_.clear(); }
  static constexpr std::size_t kChanges = 64;

 private:
  // sim_drive.cpp: power on, time, NMT
  void emit(const hal::CanFrame& frame, Outbox& out) const noexcept;
  [[nodiscard]] bool silent() const noexcept;
  [[nodiscard]] bool beats() const noexcept;
  void on_nmt(NmtOrder order, Outbox& out) noexcept;
  void enter(NmtState state, Outbox& out) noexcept;
  void reset(bool application, Outbox& out) noexcept;
  void boot(Outbox& out) noexcept;
  void send_heartbeat(Outbox& out) noexcept;
  void note_change() noexcept;

  // sim_drive_faults.cpp: the script
  void hold_stuck_object() noexcept;
  void follow_script(Outbox& out) noexcept;
  void apply(const SimEvent& event, Outbox& out) noexcept;
  void play_others(Outbox& out) noexcept;
  void produce_sync(Outbox& out) noexcept;
  [[nodiscard]] bool due(SimFault fault, SimPeriod& period) noexcept;

  // sim_drive_power.cpp: the motor and its states
  [[nodiscard]] SimOptionCodes options() const noexcept;
  [[nodiscard]] std::int32_t limited_target() const noexcept;
  [[nodiscard]] bool follows() const noexcept;
  void move(Duration time) noexcept;
  void command(std::uint16_t controlword) noexcept;
  void fail(std::uint16_t code) noexcept;
  void lose_connection(std::uint16_t code) noexcept;
  void communication_error(SimEmergencies::Source source, std::uint16_t code) noexcept;
  void watch_others(Outbox& out) noexcept;
  void refresh_actual_values() noexcept;
  [[nodiscard]] std::uint16_t statusword() const noexcept;
  [[nodiscard]] SimEmergencies::Vendor vendor_bytes() const noexcept;

  // sim_drive_sdo.cpp: what may be read and written
  void on_sdo(const hal::CanFrame& request, Outbox& out) noexcept;
  [[nodiscard]] std::optional<SdoAbort> scripted_abort(ObjectAddress address) const noexcept;
  [[nodiscard]] std::optional<SdoAbort> upload(ObjectAddress address, SdoContent& content) noexcept;
  [[nodiscard]] std::optional<SdoAbort> download(ObjectAddress address, const SdoContent& content,
                                                 bool size_given) noexcept;
  [[nodiscard]] std::optional<SdoAbort> refusal(const ObjectEntry& entry, std::uint32_t value) const noexcept;
  void written(ObjectAddress address) noexcept;
  void answer_sdo(hal::CanFrame frame, Outbox& out) noexcept;
  void send_delayed(Outbox& out) noexcept;

  // sim_drive_pdo.cpp: process data
  void configure_pdos() noexcept;
  void on_sync(const hal::CanFrame& frame, Outbox& out) noexcept;
  void on_rpdo(std::size_t number, const hal::CanFrame& frame) noexcept;
  void apply_rpdo(std::size_t number, const hal::CanFrame& frame) noexcept;
  void send_event_tpdos(Outbox& out) noexcept;
  void send_tpdo(std::size_t number, hal::CanFrame frame, Outbox& out) noexcept;
  void watch_rpdo_deadlines() noexcept;
  void send_emergencies(Outbox& out) noexcept;

  struct Delayed {
    Instant due{};
    hal::CanFrame frame;
  };

  std::uint8_t node_id_;
  DriveParameters parameters_;
  SimScript script_;
  SimFaults faults_;
  std::uint32_t dummies_ = 0;
  ObjectDictionary objects_;
  SimPower power_;
  SimMotion motion_;
  SimEncoder encoder_;
  SimEmergencies emergencies_;
  SimHeartbeats heartbeats_;
  SimSdoServer sdo_;
  NmtState nmt_ = NmtState::kBootUp;
  Instant now_{};
  std::optional<Instant> powered_again_;  // of a reboot that takes time
  HeartbeatProducer heartbeat_{Duration::zero()};
  SimPeriod twin_heartbeat_;     // of SimFault::kDuplicateNode
  SimPeriod foreign_heartbeat_;  // of SimFault::kForeignMaster
  SimPeriod foreign_request_;    // of SimFault::kForeignClient
  SimPeriod own_sync_;
  SimPeriod storm_;
  std::array<SimPdo, kSimPdos> rpdos_;
  std::array<std::optional<hal::CanFrame>, kSimPdos> rpdo_frames_;  // received since the last SYNC
  std::array<std::optional<Instant>, kSimPdos> rpdo_heard_;         // for the deadline
  std::array<SimTpdo, kSimPdos> tpdos_;
  std::array<std::optional<hal::CanFrame>, kSimPdos> tpdos_held_;    // of late and reordered ones
  std::array<std::optional<hal::CanFrame>, kSimPdos> tpdos_before_;  // the last sent, of stuck ones
  std::optional<Instant> last_sync_;
  StaticVector<Delayed, 8> delayed_;
  StaticVector<SimChange, kChanges> changes_;
  SimChange last_change_;
  bool first_change_ = true;
};

}  // namespace ivo::drivers
