// An IVO-class base: four omnidirectional wheels, each with a CiA 402 velocity drive. Everything about wheels and bus
// is configuration (config/robots/*.toml), because IVO's own drives are not public.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "config/base/time.hpp"

namespace ivo {

inline constexpr int kWheels = 4;

/// Order of every array of wheels in the product.
enum class Wheel : std::uint8_t { kFrontLeft, kFrontRight, kRearLeft, kRearRight };

enum class WheelGeometry : std::uint8_t {
  kMecanum,  ///< rollers at 45 degrees, axles parallel
  kOmniX,    ///< omni wheels at the corners, axles along the diagonals
};

struct BaseParameters {
  WheelGeometry geometry = WheelGeometry::kMecanum;
  double wheel_radius_m = 0.10;
  double half_length_m = 0.20;  ///< lx: centre to axle, along x
  double half_width_m = 0.20;   ///< ly: centre to wheel, along y
  double max_wheel_radps = 15.0;
  double turn_scale = 1.0;  ///< lever arm of a turn over its geometric one (lx + ly, or R): what a calibration finds
  friend bool operator==(const BaseParameters&, const BaseParameters&) = default;
};

struct MotionLimits {
  double max_speed_mps = 1.0;  ///< along the path, whatever the mission says
  double max_turn_radps = 1.0;
  double max_accel_mps2 = 0.5;  ///< speeding up and planned slowing down
  double max_turn_accel_radps2 = 1.5;
  double stop_decel_mps2 = 1.0;  ///< ramp of an unplanned stop, while the loop still commands
  double quick_stop_mps2 = 2.0;  ///< at each wheel's rim: the ramp with which a drive stops by itself (6085h)
  friend bool operator==(const MotionLimits&, const MotionLimits&) = default;
};

struct DriveParameters {
  std::uint8_t node_id = 1;         ///< CANopen node-id, 1 to 127
  int sign = 1;                     ///< +1 or -1: +1 when a positive target drives the robot towards +x
  double gear_ratio = 1.0;          ///< motor turns for one wheel turn
  double counts_per_turn = 4096.0;  ///< encoder counts for one motor turn (6064h)
  double velocity_per_radps =
      651.8986469044033;  ///< units of 60FFh for 1 rad/s at the motor; counts/s here: 4096 / (2 pi)
  double accel_per_radps2 = 651.8986469044033;  ///< units of 6083h, 6084h and 6085h for 1 rad/s2 at the motor
  std::uint32_t vendor_id = 0;                  ///< expected 1018h:1, 0 accepts any
  std::uint32_t product_code = 0;               ///< expected 1018h:2, 0 accepts any
  std::string eds{};                            ///< path of the drive's EDS; empty: none is checked
  friend bool operator==(const DriveParameters&, const DriveParameters&) = default;
};

/// One input line of a GPIO chip.
struct InputLine {
  unsigned line = 0;        ///< offset on the chip
  bool active_low = false;  ///< true: pressed when the level is low, as with a normally closed contact to the supply
  friend bool operator==(const InputLine&, const InputLine&) = default;
};

inline constexpr std::size_t kBumpers = 7;  ///< and an emergency stop: eight inputs, a byte

/// Emergency stop and bumpers. An input that is not fitted is never pressed.
struct InputParameters {
  std::string chip{};  ///< "gpiochip0", a path or a label; empty: there are no inputs
  std::optional<InputLine> emergency_stop{};
  std::array<std::optional<InputLine>, kBumpers> bumpers{};
  friend bool operator==(const InputParameters&, const InputParameters&) = default;
};

/// The control loop's thread, and what it does when it is late (firmware/loop/overrun_policy.hpp).
struct LoopParameters {
  int ramp_down_at = 3;      ///< periods lost soon one after the other: the robot ramps down until they are forgotten
  int latch_at = 5;          ///< ditto: a fault, which only an operator clears
  int priority = 80;         ///< SCHED_FIFO, 1 to 99
  std::optional<int> cpu{};  ///< that the thread is pinned to; none: wherever the process may run
  /// Whoever set the robot off from a page is not heard for so long: it ramps down and stands.
  Duration beat_timeout = std::chrono::seconds(2);
  friend bool operator==(const LoopParameters&, const LoopParameters&) = default;
};

/// How commands reach the drives; feedback is one TPDO a drive in both.
enum class PdoLayout : std::uint8_t {
  kOwn,     ///< one RPDO a drive: {6040h, 60FFh}
  kShared,  ///< targets of two drives in one RPDO: {60FFh, 60FFh}; controlwords {6040h} in one RPDO a drive, when they
            ///< change and every rates::kControlwordRefresh. For 1 kHz at 1 Mbit/s.
};

/// Without a file: an IVO-class base as config/robots/ivo.toml has it.
struct Robot {
  std::string name = "IVO";
  double footprint_radius_m = 0.30;
  BaseParameters base;
  MotionLimits limits;
  std::uint32_t bit_rate_bps = 1'000'000;
  std::uint8_t master_node_id = 127;
  PdoLayout pdo_layout = PdoLayout::kOwn;
  Duration cycle = std::chrono::milliseconds(2);  ///< of loop and SYNC: 2 ms, or 1 ms with kShared
  /// The right-hand wheels are mounted the other way round.
  std::array<DriveParameters, kWheels> drives = {
      {{.node_id = 1, .sign = 1}, {.node_id = 2, .sign = -1}, {.node_id = 3, .sign = 1}, {.node_id = 4, .sign = -1}}};
  InputParameters inputs{};
  LoopParameters loop{};
  friend bool operator==(const Robot&, const Robot&) = default;
};

}  // namespace ivo
