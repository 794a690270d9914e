// A simulated wheel drive: CANopen node (CiA 301) with velocity drive (CiA 402), as far as a wheel needs them.
//
// NMT, boot-up, heartbeat both ways, EMCY, expedited SDO server, one RPDO and one TPDO as mapped, SYNC; power state
// machine, profile and cyclic synchronous velocity with ramps, quick stop, fault reaction, reaction to a lost master by
// 6007h.
#pragma once

#include <cstdint>
#include <optional>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/heartbeat.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/sim/object_dictionary.hpp"
#include "drivers/sim/sim_motion.hpp"
#include "drivers/sim/sim_power.hpp"
#include "drivers/sim/sim_script.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

/// Time is handed in; the same frames and times in give the same frames out, bit for bit. No heap, nothing waits.
class SimDrive {
 public:
  /// What the drive sends: at most kFramesPerCall for one call below.
  using Outbox = StaticVector<hal::CanFrame, 64>;
  static constexpr std::size_t kFramesPerCall = 8;

  explicit SimDrive(const DriveParameters& drive, const SimScript& script = {}) noexcept;

  /// Power on: boot-up message, NMT state Pre-operational.
  void open(Outbox& out) noexcept;
  /// Time goes on to `now`: motion, heartbeats, the script.
  void advance_to(Instant now, Outbox& out) noexcept;
  /// A frame of another node. SYNC applies the last RPDO1 and sends TPDO1.
  void on_frame(const hal::CanFrame& frame, Outbox& out) noexcept;

  [[nodiscard]] Instant now() const noexcept { return now_; }
  [[nodiscard]] Duration sync_period() const noexcept;  ///< 1006h
  [[nodiscard]] cia402::PowerState power_state() const noexcept { return power_.state(); }
  [[nodiscard]] NmtState nmt_state() const noexcept { return nmt_; }
  [[nodiscard]] const SimMotion& motion() const noexcept { return motion_; }
  /// To change what it does from now on.
  [[nodiscard]] SimScript& script() noexcept { return script_; }

 private:
  void emit(const hal::CanFrame& frame, Outbox& out) const noexcept;
  void emit_emergency(std::uint16_t code, Outbox& out) noexcept;

  void on_nmt(NmtOrder order, Outbox& out) noexcept;
  void enter(NmtState state, Outbox& out) noexcept;
  void reset(bool application, Outbox& out) noexcept;
  void lose_connection(Outbox& out) noexcept;
  void fail(std::uint16_t code, Outbox& out) noexcept;
  void command(std::uint16_t controlword, Outbox& out) noexcept;

  void on_sdo(const SdoMessage& request, Outbox& out) noexcept;
  [[nodiscard]] std::optional<SdoAbort> download(const SdoMessage& request, Outbox& out) noexcept;
  [[nodiscard]] std::optional<SdoAbort> refusal(const ObjectEntry& entry, std::uint32_t value) const noexcept;
  [[nodiscard]] std::optional<SdoAbort> mapping_refusal(ObjectAddress address, std::uint32_t value) const noexcept;
  void written(ObjectAddress address, Outbox& out) noexcept;

  void on_sync(Outbox& out) noexcept;
  void apply_rpdo(const hal::CanFrame& frame, Outbox& out) noexcept;
  void send_tpdo(Outbox& out) noexcept;
  [[nodiscard]] int mapped_bits(ObjectAddress count) const noexcept;
  void move(Duration time) noexcept;
  void refresh_actual_values() noexcept;
  void hold_stuck_object() noexcept;
  void follow_script(Outbox& out) noexcept;
  void watch_master(Outbox& out) noexcept;

  std::uint8_t node_id_;
  SimScript script_;
  ObjectDictionary objects_;
  SimPower power_;
  SimMotion motion_;
  NmtState nmt_ = NmtState::kBootUp;
  Instant now_{};
  HeartbeatProducer heartbeat_{Duration::zero()};
  HeartbeatConsumer master_{Duration::zero()};
  bool master_lost_ = false;
  std::optional<hal::CanFrame> rpdo_;  // received since the last SYNC
  std::uint8_t syncs_ = 0;             // since the last TPDO1
};

}  // namespace ivo::drivers
