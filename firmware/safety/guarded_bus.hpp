// The second of two doors that motion passes: a bus that judges every frame before the real one sees it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "config/limits.hpp"
#include "config/robot.hpp"
#include "firmware/safety/frame_rules.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::firmware {

/// Frames that FrameRules refuses never reach the inner bus; the others of the same span do, in order, in one call of
/// it. A refused frame that could move a wheel takes with it all others of the span that could. Receiving, state
/// and the counters are the inner bus's, but for send_refused. One thread: the loop's.
class GuardedBus final : public hal::CanBus {
 public:
  /// `inner` is the caller's and must outlive this.
  GuardedBus(hal::CanBus& inner, const Robot& robot) noexcept : inner_(inner), rules_(robot) {}

  /// Said anew in every cycle, between receive and send. A permit lets one frame that can move a wheel pass on each way
  /// to each drive (MotionWays); it ends when it is used, at the next receive, or with false. So a loop that
  /// hangs in sending, or goes round without deciding, cannot go on moving the robot. While motion is permitted no SDO
  /// passes.
  void permit_motion(bool permitted) noexcept {
    in_motion_ = permitted;
    permits_ = permitted ? kAllWays : MotionWays{0};
  }

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override;

  /// How many of the frames the inner bus took; refused ones are not among them. More than
  /// limits::kFramesPerCycle are several calls of the inner bus. Cost: a copy of those that pass.
  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override;

  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override;

  [[nodiscard]] std::uint64_t refused(FrameRefusal reason) const noexcept;
  [[nodiscard]] std::uint64_t refused() const noexcept;
  /// COB-ID of the last refused frame.
  [[nodiscard]] std::optional<std::uint16_t> last_refused_id() const noexcept { return last_refused_id_; }

 private:
  std::size_t send_part(std::span<const hal::CanFrame> frames, Instant now) noexcept;
  [[nodiscard]] FrameRefusal judge(const hal::CanFrame& frame, MotionWays moved) noexcept;
  void refuse(const hal::CanFrame& frame, FrameRefusal refusal) noexcept;

  hal::CanBus& inner_;
  FrameRules rules_;
  bool in_motion_ = false;
  MotionWays permits_ = 0;  // not used yet
  std::array<hal::CanFrame, limits::kFramesPerCycle> passing_{};
  std::array<std::uint64_t, kFrameRefusals> refused_{};
  std::optional<std::uint16_t> last_refused_id_;
};

}  // namespace ivo::firmware
