#include "firmware/tools/wheels/wheel_turner.hpp"

#include <algorithm>
#include <cmath>

namespace ivo::firmware {
namespace {

using drivers::DriveFault;
using drivers::DriveFaultReason;
using drivers::GroupState;

Robot slow(Robot robot) noexcept {
  robot.base.max_wheel_radps = std::min(robot.base.max_wheel_radps, WheelTurner::kFastestRadps);
  return robot;
}

}  // namespace

WheelTurner::WheelTurner(hal::CanBus& bus, const Robot& robot, hal::DigitalInputs* inputs) noexcept
    : bus_(bus, slow(robot)),
      drives_(bus_, robot),
      stop_inputs_(robot.inputs),
      latch_at_(robot.loop.latch_at),
      inputs_(inputs),
      cycle_(robot.cycle),
      longest_step_(2 * robot.cycle) {
  std::ranges::transform(robot.drives, scales_.begin(), TurnMeasure::scale_of);
}

void WheelTurner::open(Instant now) noexcept {
  now_ = now;
  last_key_ = now;
  drives_.open(now);
}

void WheelTurner::give(const TurnOrder& order) noexcept {
  order_ = order;
  order_.radps = std::isfinite(order.radps) ? std::clamp(order.radps, -kFastestRadps, kFastestRadps) : 0.0;
  ++orders_;
  limit_reached_ = false;
  told_radps_ = 0.0;  // another wheel's
  key_.forbid();
  measure_.begin(order.wheel, scales_[static_cast<std::size_t>(order.wheel)], order.expected, wheels_.angle_rad);
}

const TurnStatus& WheelTurner::cycle(Instant now, std::int64_t skipped, const Keys& keys) noexcept {
  // What the scheduler tells is of the cycle before; one that overslept sees it by its own clock.
  const std::int64_t late = std::max<std::int64_t>(skipped, (now - now_) / cycle_ - 1);
  dt_ = std::min(now - now_, longest_step_);
  now_ = now;
  drain_bus();
  look_at_drives(late);
  listen_to_keys(keys);
  measure();
  look_for_end(keys);
  decide_power();
  choose_speed();
  write();
  publish();
  return status_;
}

void WheelTurner::drain_bus() noexcept {
  const std::size_t received = bus_.receive(frames_, now_);
  for (std::size_t i = 0; i < received; ++i) {
    drives_.on_frame(frames_[i]);
  }
}

void WheelTurner::look_at_drives(std::int64_t late) noexcept {
  wheels_ = drives_.update(now_);
  if (enable_ && late >= latch_at_) {
    fail({.reason = DriveFaultReason::kCycleLate, .code = static_cast<std::uint32_t>(late)});
  }
  const hal::DigitalSnapshot snapshot = inputs_ != nullptr ? inputs_->snapshot(now_) : hal::DigitalSnapshot{};
  if (const auto pressed = stop_inputs_.judge(snapshot)) {
    fail(*pressed);
  }
}

void WheelTurner::fail(const DriveFault& fault) noexcept {
  drives_.fail(fault, now_);
  wheels_ = drives_.feedback();
}

void WheelTurner::listen_to_keys(const Keys& keys) noexcept {
  const bool touched_before = key_.touched();
  key_.update(now_);
  if (keys.hold) {
    key_.press(now_);
  }
  if (keys.hold || keys.other) {
    last_key_ = now_;
  }
  if (key_.touched() && !touched_before) {
    measure_.forget_note();
  }
}

void WheelTurner::measure() noexcept {
  if (orders_ == 0) {
    return;
  }
  const TurnNote before = measure_.result().note;
  measure_.update({.now = now_, .dt = dt_, .told_radps = told_radps_, .angles_rad = wheels_.angle_rad});
  const TurnMeasure::Result& seen = measure_.result();
  if (seen.note != TurnNote::kNone && before == TurnNote::kNone) {
    key_.forbid();
    cut_ = true;
  }
  const double way_to_stop_rad = told_radps_ * told_radps_ / (2.0 * kRampDownRadps2);
  if (order_.limit_rad > 0.0 && std::abs(seen.rad) + way_to_stop_rad >= order_.limit_rad) {
    limit_reached_ = true;
    key_.forbid();
  }
}

void WheelTurner::look_for_end(const Keys& keys) noexcept {
  if (wheels_.state == GroupState::kFault) {
    end(TurnEnd::kFault);
  } else if (keys.end) {
    end(TurnEnd::kAsked);
  } else if (now_ - last_key_ > kPatience) {
    end(TurnEnd::kNobodyThere);
  }
}

void WheelTurner::end(TurnEnd why) noexcept {
  if (end_ == TurnEnd::kNone) {
    end_ = why;
    end_at_ = now_;
    drives_.stop(now_);
  }
}

void WheelTurner::decide_power() noexcept {
  if (key_.touched() || told_radps_ != 0.0) {
    last_use_ = now_;
  }
  cut_ = cut_ && wheels_.state != GroupState::kReady;
  const bool in_use = last_use_.has_value() && now_ - *last_use_ <= kPowerOffAfter;
  // Not during start-up, whose SDO the door keeps apart from motion.
  const bool started = wheels_.state != GroupState::kBooting;
  enable_ = in_use && started && !cut_ && orders_ > 0 && end_ == TurnEnd::kNone;
}

void WheelTurner::choose_speed() noexcept {
  if (!enable_ || wheels_.state != GroupState::kEnabled) {
    told_radps_ = 0.0;
    return;
  }
  const double goal = key_.held() ? order_.radps : 0.0;
  const bool speeds_up = std::abs(goal) > std::abs(told_radps_);
  const double step = (speeds_up ? kRampUpRadps2 : kRampDownRadps2) * seconds(dt_);
  told_radps_ = std::clamp(goal, told_radps_ - step, told_radps_ + step);
}

void WheelTurner::write() noexcept {
  drivers::WheelTargets targets;
  targets.radps[static_cast<std::size_t>(order_.wheel)] = told_radps_;
  bus_.permit_motion(enable_);
  drives_.write(now_, enable_, targets);
}

TurnPhase WheelTurner::phase() const noexcept {
  if (end_ != TurnEnd::kNone) {
    return wheels_.off || now_ - end_at_ > kGiveUp ? TurnPhase::kEnded : TurnPhase::kEnding;
  }
  switch (wheels_.state) {
    case GroupState::kBooting:
      return TurnPhase::kStarting;
    case GroupState::kReady:
      return enable_ ? TurnPhase::kPowering : TurnPhase::kOff;
    case GroupState::kEnabling:
      return TurnPhase::kPowering;
    case GroupState::kEnabled:
      if (key_.held()) {
        return TurnPhase::kTurning;
      }
      return told_radps_ != 0.0 ? TurnPhase::kSlowing : TurnPhase::kWaiting;
    case GroupState::kStopping:
      return TurnPhase::kSlowing;
    case GroupState::kFault:
      break;
  }
  return TurnPhase::kEnding;
}

void WheelTurner::publish() noexcept {
  status_ = {.at = now_,
             .phase = phase(),
             .key = key_.state(),
             .wheel = order_.wheel,
             .order = orders_,
             .limit_reached = limit_reached_,
             .turned = measure_.result(),
             .end = end_,
             .fault = wheels_.fault,
             .power_off = wheels_.off,
             .bus = bus_.counters(),
             .bus_state = bus_.state(),
             .refused_frames = bus_.refused()};
}

}  // namespace ivo::firmware
