// What the four drives and their controller say, by listening alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "config/limits.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/emcy.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/wheel_encoder.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::firmware {

/// Of one wheel's node.
struct HeardNode {
  std::optional<drivers::NmtState> state;
  Instant heartbeat_at{};  ///< the last, boot-up too
  std::uint64_t boot_ups = 0;
  /// Of the first of its TPDOs that is as long as {6041h, 6064h}: a drive whose mappings are fixed has not TPDO1 so.
  std::optional<drivers::DriveStatus> status;
  int status_tpdo = 0;  ///< its number; 0: none yet
  Instant status_at{};
  std::optional<double> told_radps;  ///< by the controller, at the wheel, in the robot's PDO layout
  std::optional<drivers::Emergency> emergency;
  Instant emergency_at{};
  std::uint64_t emergencies = 0;
};

/// Of the last whole second, or of less while there was none.
struct BusTraffic {
  double load = 0.0;  ///< share of the bit rate, stuffing as it was
  double frames_per_s = 0.0;
  double syncs_per_s = 0.0;
};

/// Sends nothing: it is given no bus to send on. Each cycle: on_frame for what was received, then update.
class BusListener {
 public:
  explicit BusListener(const Robot& robot) noexcept;

  void on_frame(const hal::ReceivedFrame& received) noexcept;
  void update(Instant now) noexcept;

  [[nodiscard]] const HeardNode& node(Wheel wheel) const noexcept { return nodes_[static_cast<std::size_t>(wheel)]; }
  /// At the wheel, from its positions.
  [[nodiscard]] double radps(Wheel wheel, Instant now) const noexcept;
  [[nodiscard]] double angle_rad(Wheel wheel) const noexcept {
    return encoders_[static_cast<std::size_t>(wheel)].angle_rad();
  }
  [[nodiscard]] const BusTraffic& traffic() const noexcept { return traffic_; }
  [[nodiscard]] std::optional<Instant> controller_at() const noexcept {
    return controller_at_;
  }  ///< its last heartbeat
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }

 private:
  void take(std::size_t wheel, const hal::ReceivedFrame& received) noexcept;
  void take_status(std::size_t wheel, const hal::ReceivedFrame& received) noexcept;
  void take_targets(const hal::CanFrame& frame) noexcept;
  void told(std::size_t wheel, std::int32_t target) noexcept;

  Robot robot_;
  std::array<HeardNode, kWheels> nodes_;
  std::array<drivers::WheelEncoder, kWheels> encoders_;
  BusTraffic traffic_;
  std::optional<Instant> controller_at_;
  std::uint64_t frames_ = 0;
  std::optional<Instant> counting_since_;
  std::uint64_t counted_frames_ = 0;
  std::uint64_t counted_syncs_ = 0;
  std::uint64_t counted_bits_ = 0;
};

}  // namespace ivo::firmware
