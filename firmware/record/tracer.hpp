// The loop's pen: what a cycle does, into the ring and, where it is asked for, into the kernel's own trace.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "config/base/geometry.hpp"
#include "config/base/time.hpp"
#include "firmware/record/trace_event.hpp"
#include "hal/api/can_frame.hpp"
#include "hal/api/clock.hpp"
#include "hal/api/cycle_marker.hpp"

namespace ivo::firmware {

/// A default one writes nothing and costs a comparison a call; otherwise a call is the copy of 40 bytes, and with a
/// marker a system call. A phase begins where the one before it ended, the first where the cycle did. Thread: the
/// loop's.
class Tracer {
 public:
  Tracer() noexcept = default;
  /// Ring and marker may be null; what is given outlives this. `stopwatch`: the one that the loop measures with.
  Tracer(hal::Clock& stopwatch, TraceRing* ring, hal::CycleMarker* marker = nullptr) noexcept
      : stopwatch_(&stopwatch), ring_(ring), marker_(marker) {}

  /// Whether anything is written: a stopwatch is read for nobody else's sake.
  [[nodiscard]] bool on() const noexcept { return ring_ != nullptr || marker_ != nullptr; }

  /// `loop_time`: as the cycle has it. `at` and all that follows: the stopwatch's.
  void cycle_began(Instant loop_time, Instant at, Duration latency, std::int64_t skipped) noexcept {
    if (!on()) {
      return;
    }
    at_ = at;
    began_ = at;
    TraceEvent event = here(TraceKind::kCycleBegan);
    event.put(TracedCycle{loop_time.time_since_epoch().count(), latency.count(), skipped});
    push(event);
    if (marker_ != nullptr) {
      marker_->begin_cycle();
    }
  }

  /// `code`: counted from 0, in the order of the cycle.
  void phase(std::uint8_t code, Instant begin, Instant end) noexcept {
    if (!on()) {
      return;
    }
    push(lasting(TraceKind::kPhase, code, begin, end));
    at_ = end;
    if (marker_ != nullptr) {
      marker_->end_phase(code);
    }
  }

  /// At the end of its last phase.
  void cycle_ended() noexcept {
    if (!on()) {
      return;
    }
    TraceEvent event = lasting(TraceKind::kCycleEnded, 0, began_, at_);
    event.put(work_);
    push(event);
    work_ = {};
    if (marker_ != nullptr) {
      marker_->end_cycle();
    }
  }

  /// For slice(): when it begins.
  [[nodiscard]] Instant now() noexcept { return on() ? stopwatch_->now() : Instant{}; }
  /// Of the planner, from `begin` until now.
  void slice(std::uint8_t code, Instant begin, std::int64_t units, std::int64_t moves) noexcept {
    if (ring_ != nullptr) {
      TraceEvent event = lasting(TraceKind::kSlice, code, begin, stopwatch_->now());
      event.put(TracedWork{units, moves});
      push(event);
      work_.units += units;
      work_.moves += moves;
    }
  }

  /// `now`: the loop's, as the frames' own.
  void frames_in(std::span<const hal::ReceivedFrame> frames, Instant now) noexcept {
    if (ring_ != nullptr) {
      for (const hal::ReceivedFrame& received : frames) {
        TraceEvent event = of(TraceKind::kFrameIn, received.frame);
        event.lasted_ns = whole(now - received.at);
        push(event);
      }
    }
  }
  void frames_out(std::span<const hal::CanFrame> frames) noexcept {
    if (ring_ != nullptr) {
      for (const hal::CanFrame& frame : frames) {
        push(of(TraceKind::kFrameOut, frame));
      }
    }
  }

  void mode(std::uint8_t code) noexcept { put(TraceKind::kMode, code, 0, TracedFault{}); }
  void bus_state(std::uint8_t code) noexcept { put(TraceKind::kBusState, code, 0, TracedFault{}); }
  void fault(std::uint8_t reason, std::uint16_t wheel, const TracedFault& fault) noexcept {
    put(TraceKind::kFault, reason, wheel, fault);
  }

  void pose(std::uint16_t agent, const Pose& pose) noexcept {
    put(TraceKind::kPose, 0, agent, TracedPose{pose.x_m, pose.y_m, pose.heading_rad});
  }
  void command(const Twist& twist) noexcept {
    put(TraceKind::kCommand, 0, 0, TracedTwist{twist.vx_mps, twist.vy_mps, twist.wz_radps});
  }
  /// Four each, in the order of Wheel.
  void wheels(std::span<const double, 4> told_radps, std::span<const double, 4> angle_rad) noexcept {
    put(TraceKind::kToldWheels, 0, 0, narrow(told_radps));
    put(TraceKind::kWheelAngles, 0, 0, narrow(angle_rad));
  }

 private:
  [[nodiscard]] static std::uint32_t whole(Duration lasted) noexcept {
    constexpr Duration::rep kMost = std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint32_t>(std::clamp<Duration::rep>(lasted.count(), 0, kMost));
  }
  [[nodiscard]] static TracedWheels narrow(std::span<const double, 4> values) noexcept {
    TracedWheels narrowed;
    std::transform(values.begin(), values.end(), narrowed.wheels.begin(),
                   [](double value) { return static_cast<float>(value); });
    return narrowed;
  }
  [[nodiscard]] TraceEvent here(TraceKind kind) const noexcept {
    TraceEvent event;
    event.at = at_;
    event.kind = kind;
    return event;
  }
  [[nodiscard]] static TraceEvent lasting(TraceKind kind, std::uint8_t code, Instant begin, Instant end) noexcept {
    TraceEvent event;
    event.at = begin;
    event.lasted_ns = whole(end - begin);
    event.kind = kind;
    event.code = code;
    return event;
  }
  [[nodiscard]] TraceEvent of(TraceKind kind, const hal::CanFrame& frame) const noexcept {
    TraceEvent event = here(kind);
    event.code = frame.size;
    event.id = frame.id;
    event.put(TracedFrame{frame.data, {}});
    return event;
  }
  template <class Payload>
  void put(TraceKind kind, std::uint8_t code, std::uint16_t id, const Payload& payload) noexcept {
    if (ring_ != nullptr) {
      TraceEvent event = here(kind);
      event.code = code;
      event.id = id;
      event.put(payload);
      push(event);
    }
  }
  void push(const TraceEvent& event) noexcept {
    if (ring_ != nullptr) {
      (void)ring_->push(event);  // a loss is counted by the ring
    }
  }

  hal::Clock* stopwatch_ = nullptr;
  TraceRing* ring_ = nullptr;
  hal::CycleMarker* marker_ = nullptr;
  Instant at_{};     // the stopwatch, when it was last read
  Instant began_{};  // ditto, of the cycle
  TracedWork work_;  // of the cycle so far
};

}  // namespace ivo::firmware
