// How full the bus is: as computed from what a robot's layout sends in every cycle, and as counted from frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

/// By COB-ID of the predefined connection set (CiA 301, 7.3.5).
enum class FrameKind : std::uint8_t { kNmt, kSync, kEmcy, kTpdo, kRpdo, kSdo, kHeartbeat, kOther };
inline constexpr std::size_t kFrameKinds = 8;
[[nodiscard]] FrameKind kind_of(std::uint16_t id) noexcept;

struct PeriodicFrame {
  std::uint16_t id = 0;
  std::uint8_t bytes = 0;
  Duration period{};
  bool after_sync = false;  ///< queued when SYNC has arrived, else at the beginning of the period
};
using BusSchedule = StaticVector<PeriodicFrame, 32>;

/// What goes over the bus while the robot drives: SYNC, PDOs and heartbeats.
[[nodiscard]] BusSchedule schedule_of(const Robot& robot) noexcept;

/// Request and answer of one SDO transfer to `node_id` every `period`.
[[nodiscard]] std::array<PeriodicFrame, 2> sdo_transfer_every(Duration period, std::uint8_t node_id) noexcept;

/// Shares of what the bit rate carries.
struct BusLoad {
  double unstuffed = 0.0;
  double worst = 0.0;  ///< every frame as long as stuffing can make it
};
[[nodiscard]] BusLoad load_of(std::span<const PeriodicFrame> frames, std::uint32_t bit_rate_bps) noexcept;

/// Room is left for start-up, emergencies, changes of state and frames that are sent again.
inline constexpr double kMostWorstLoad = 0.85;
/// Whether the schedule of `robot` is within kMostWorstLoad.
[[nodiscard]] bool fits(const Robot& robot) noexcept;

/// Counts the load of frames as they came, each with its very bits. About 1 KB; one thread. Cost: the frame's bits.
class LoadMeter {
 public:
  static constexpr std::size_t kShortMs = 10;
  static constexpr std::size_t kLongMs = 100;

  struct Share {
    std::uint64_t frames = 0;
    double load = 0.0;  ///< of the whole time
  };
  struct Figures {
    std::uint64_t frames = 0;
    Duration time{};          ///< from the first frame to the last
    double mean = 0.0;        ///< in that time; 0 of fewer than two frames
    double worst_10ms = 0.0;  ///< of windows that begin at whole milliseconds after the first frame
    double worst_100ms = 0.0;
    std::array<Share, kFrameKinds> kinds{};
  };

  explicit LoadMeter(std::uint32_t bit_rate_bps) noexcept : bit_rate_bps_(bit_rate_bps) {}

  /// A frame that was there at `at`. One that is earlier than the one before counts as if it came with that.
  void add(Instant at, const hal::CanFrame& frame) noexcept;
  [[nodiscard]] Figures figures() const noexcept;

 private:
  void pass_to(std::int64_t ms) noexcept;

  std::uint32_t bit_rate_bps_;
  Instant first_{};
  Instant last_{};
  std::int64_t ms_ = 0;  // of last_, since first_
  std::array<std::int64_t, kLongMs> bits_in_ms_{};
  std::int64_t short_bits_ = 0;  // in the last kShortMs, the present one among them
  std::int64_t long_bits_ = 0;
  std::int64_t most_short_bits_ = 0;
  std::int64_t most_long_bits_ = 0;
  std::array<std::uint64_t, kFrameKinds> frames_{};
  std::array<std::int64_t, kFrameKinds> bits_{};
};

}  // namespace ivo::drivers
