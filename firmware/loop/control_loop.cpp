#include "firmware/loop/control_loop.hpp"

#include <algorithm>
#include <chrono>

#include "config/rates.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;

constexpr Duration kPositionEvery = 200ms;    // in the event log
constexpr std::int64_t kForgetPeriodIn = 20;  // cycles in time make one lost period forgotten
constexpr int kLongestStep = 2;               // cycles: a late one must not let the velocity jump
// After this long in an end mode nobody waits for the drives any more: they stop by our missing heartbeat.
constexpr Duration kGiveUp = rates::kStandstillTimeout + rates::kStateChangeTimeout;

// The mission says how fast the robot searches; nothing may drive it faster.
MotionLimits planned_limits(const LoopSetup& setup) noexcept {
  MotionLimits limits = setup.robot.limits;
  limits.max_speed_mps = std::min(limits.max_speed_mps, setup.searchers[0].speed_mps);
  return limits;
}

bool at_rest(const Twist& twist) noexcept {
  return twist.vx_mps == 0.0 && twist.vy_mps == 0.0 && twist.wz_radps == 0.0;
}

}  // namespace

ControlLoop::ControlLoop(const LoopSetup& setup, planner::Planner& planner, hal::CanBus& bus) noexcept
    : planner_(planner),
      bus_(bus, setup.robot),
      drives_(bus_, setup.robot),
      kinematics_(setup.robot.base),
      odometry_(kinematics_),
      limiter_(planned_limits(setup)),
      follower_(planned_limits(setup)),
      gate_(planned_limits(setup), rates::kFeedbackTimeout),
      monitor_(setup.robot),
      stop_inputs_(setup.robot.inputs),
      inputs_(setup.inputs),
      search_(planner.cells(), setup.searchers),
      object_(setup.object),
      start_(setup.start),
      cycle_(setup.robot.cycle),
      longest_step_(kLongestStep * setup.robot.cycle),
      fault_waits_(setup.fault_waits) {
  odometry_.reset(start_);
}

void ControlLoop::open(Instant now) noexcept {
  now_ = now;
  drives_.open(now);
}

void ControlLoop::cycle(Instant now, std::int64_t skipped) noexcept {
  // What the scheduler tells is of the cycle before; one that overslept sees it by its own clock.
  const std::int64_t late = std::max<std::int64_t>(skipped, (now - now_) / cycle_ - 1);
  dt_ = std::min(now - now_, longest_step_);
  now_ = now;
  take_commands();
  drain_bus();
  look_at_ourselves(skipped, late);
  look_at_stop_inputs();
  look_at_drives();
  look_for_object();
  decide_mode();
  write(pass_gate(clamp(choose_velocity())));
  think();
  publish();
}

void ControlLoop::take_commands() noexcept {
  consent_ = false;
  clear_asked_ = false;
  StopCause cause = stop_requested_.load(std::memory_order_relaxed) ? StopCause::kAsked : StopCause::kNone;
  for (OperatorCommand command{}; commands_.pop(command);) {
    switch (command) {
      case OperatorCommand::kConsent:
        consent_ = true;
        break;
      case OperatorCommand::kClearFault:
        clear_asked_ = mode_ == Mode::kFault;
        break;
      case OperatorCommand::kNoConsent:
      case OperatorCommand::kPlanNotKept:
        cause = cause != StopCause::kNone                ? cause
                : command == OperatorCommand::kNoConsent ? StopCause::kNoConsent
                                                         : StopCause::kPlanNotKept;
        break;
    }
  }
  if (cause != StopCause::kNone && stop_cause_ == StopCause::kNone) {
    stop_cause_ = cause;
    record(EventKind::kStopAsked, 0, static_cast<std::int32_t>(cause));
  }
}

void ControlLoop::drain_bus() noexcept {
  const std::size_t received = bus_.receive(frames_, now_);
  for (std::size_t i = 0; i < received; ++i) {
    drives_.on_frame(frames_[i]);
  }
  if (bus_.state() != counters_.bus_state) {
    counters_.bus_state = bus_.state();
    record(EventKind::kBusState, 0, static_cast<std::int32_t>(counters_.bus_state));
  }
}

void ControlLoop::look_at_drives() noexcept {
  if (clear_asked_) {
    drives_.reset_fault();
  }
  wheels_ = drives_.update(now_);
  if (wheels_.fresh) {
    feedback_at_ = now_;
    odometry_.update(wheels_.angle_rad);
  }
  const bool enabled = wheels_.state == drivers::GroupState::kEnabled;
  if (const auto fault = monitor_.update({told_, wheels_.angle_rad, enabled}, now_)) {
    fail(*fault);
  }
  record_fault();
}

// Pressed in motion it is a fault. Before, it only keeps the robot from getting ready, as a drive without power does.
void ControlLoop::look_at_stop_inputs() noexcept {
  const auto pressed = stop_inputs_.judge(inputs_ != nullptr ? inputs_->snapshot(now_) : hal::DigitalSnapshot{});
  stop_held_ = pressed.value_or(drivers::DriveFault{});
  clear_asked_ = clear_asked_ && !pressed;
  if (pressed && permissions(mode_).may_move) {
    fail(*pressed);
  }
}

void ControlLoop::look_at_ourselves(std::int64_t skipped, std::int64_t late) noexcept {
  if (skipped > 0) {
    counters_.skipped += static_cast<std::uint64_t>(skipped);
    record(EventKind::kOverrun, 0, static_cast<std::int32_t>(skipped));
  }
  lateness_ = std::max<std::int64_t>(0, lateness_ - 1) + kForgetPeriodIn * std::max<std::int64_t>(late, 0);
  if (!permissions(mode_).may_move) {
    lateness_ = 0;
  } else if (lateness_ >= kForgetPeriodIn * rates::kLatestPeriods) {
    fail({.reason = drivers::DriveFaultReason::kCycleLate, .code = static_cast<std::uint32_t>(late)});
  }
}

void ControlLoop::record_fault() noexcept {
  const drivers::DriveFault& fault = wheels_.fault;
  if (wheels_.state == drivers::GroupState::kFault && fault.reason != fault_recorded_) {
    record(EventKind::kDriveFault, static_cast<std::uint8_t>(fault.wheel), static_cast<std::int32_t>(fault.reason));
  }
  if (fault.turning_node_id != 0 && !turning_recorded_) {
    record(EventKind::kDriveFault, static_cast<std::uint8_t>(fault.turning_wheel),
           static_cast<std::int32_t>(drivers::DriveFaultReason::kNotStill));
  }
  turning_recorded_ = fault.turning_node_id != 0;
  fault_recorded_ = wheels_.state == drivers::GroupState::kFault ? fault.reason : drivers::DriveFaultReason::kNone;
}

void ControlLoop::fail(const drivers::DriveFault& fault) noexcept {
  drives_.fail(fault, now_);
  wheels_ = drives_.feedback();
}

void ControlLoop::look_for_object() noexcept {
  // A fault of the robot that waits to be cleared does not keep the others from searching.
  const bool others_go_on = fault_waits_ && mode_ != Mode::kStopping && mode_ != Mode::kDone;
  if (!search_started_ || (mode_ != Mode::kSearching && !others_go_on) || search_.state() != SearchState::kRunning) {
    return;
  }
  search_.update(now_, odometry_.pose().point(), following_.reached);
  if (search_.state() == SearchState::kFound) {
    record(EventKind::kFound, static_cast<std::uint8_t>(*search_.finder()), 0, *object_.place());
  } else if (search_.state() == SearchState::kPathsEnded) {
    record(EventKind::kPathsEnded);
  }
  if (now_ >= next_position_) {
    next_position_ = now_ + kPositionEvery;
    for (int agent = 0; agent < search_.agents(); ++agent) {
      record(EventKind::kPosition, static_cast<std::uint8_t>(agent), 0, search_.track(agent).position);
    }
  }
}

void ControlLoop::decide_mode() noexcept {
  using drivers::GroupState;
  const bool enabled = wheels_.state == GroupState::kEnabled;
  const bool stop_held = stop_held_.reason != drivers::DriveFaultReason::kNone;
  const Mode before = mode_;
  mode_ = mode_machine_.update(
      {
          .plan_ready = plan_ready_,
          .consent_given = consent_,
          .stop_asked = stop_cause_ != StopCause::kNone,
          .clear_asked = clear_asked_,
          .search_ended = search_.state() != SearchState::kRunning,
          .drives_ready =
              !stop_held && (enabled || wheels_.state == GroupState::kReady || wheels_.state == GroupState::kEnabling),
          .drives_enabled = enabled,
          .drives_standstill = wheels_.standstill && at_rest(moving_),
          .drives_fault = wheels_.state == GroupState::kFault,
      },
      now_);
  if (mode_ != before) {
    enter(mode_);
  }
  if (mode_ == Mode::kSearching && enabled && !search_started_) {
    begin_search();
  }
  if (before == Mode::kFault && mode_ != before) {
    record(EventKind::kFaultCleared);
  }
}

void ControlLoop::enter(Mode mode) noexcept {
  record(EventKind::kMode, 0, static_cast<std::int32_t>(mode));
  if (mode == Mode::kSearching) {
    record(EventKind::kConsent);
  }
  if (mode == Mode::kDone || mode == Mode::kFault) {
    ended_ = now_;
    drives_.stop(now_);
  }
}

// Everybody sets off together: when the last drive holds speed.
void ControlLoop::begin_search() noexcept {
  search_started_ = true;
  odometry_.reset(start_);
  limiter_.reset();
  (void)follower_.start(plan_.paths[0].waypoints.span(), start_);
  search_.start(now_, plan_, object_);
  next_position_ = now_;
  record(EventKind::kSearchStarted);
}

Twist ControlLoop::choose_velocity() noexcept {
  if (mode_ != Mode::kSearching || !search_started_) {
    return {};
  }
  following_ = follower_.update({.pose = odometry_.pose(), .moving = moving_, .dt = dt_});
  return following_.command;
}

Twist ControlLoop::clamp(const Twist& wanted) noexcept {
  if (!permissions(mode_).may_move) {
    limiter_.reset();
    return {};
  }
  if (mode_ == Mode::kStopping) {
    return limiter_.ramp_down(dt_);
  }
  const double scale = kinematics_.saturation(kinematics_.wheel_speeds(wanted));
  return limiter_.limit({wanted.vx_mps * scale, wanted.vy_mps * scale, wanted.wz_radps * scale}, dt_);
}

Twist ControlLoop::pass_gate(const Twist& limited) noexcept {
  const CommandGate::Verdict verdict = gate_.judge({.may_move = permissions(mode_).may_move,
                                                    .drives_enabled = wheels_.state == drivers::GroupState::kEnabled,
                                                    .feedback_age = now_ - feedback_at_,
                                                    .pose = odometry_.pose(),
                                                    .command = limited});
  if (verdict.refusal != Refusal::kNone) {
    limiter_.reset();  // what did not go out was not driven
  }
  return verdict.command;
}

void ControlLoop::write(const Twist& passed) noexcept {
  const bool enable = permissions(mode_).enable_drives;
  bus_.permit_motion(enable);
  told_ = kinematics_.wheel_speeds(passed);
  drives_.write(now_, enable, {told_});
  moving_ = passed;
}

// Last, in what is left of the cycle: SYNC and targets never wait for a thought.
void ControlLoop::think() noexcept {
  int left = rates::kPlannerUnitsPerCycle;
  while (left > 0 && permissions(mode_).think && !plan_ready_) {
    think_a_slice({left});
    left -= std::max(1, planner_.last_slice_units());
  }
}

void ControlLoop::think_a_slice(planner::Budget budget) noexcept {
  const planner::Progress before = planner_.progress();
  const planner::Progress progress = planner_.step(budget);
  if (progress.has_plan && (!before.has_plan || progress.best.expected_time_s != before.best.expected_time_s)) {
    record(EventKind::kPlanImproved, 0, progress.generation,
           {progress.best.expected_time_s, progress.best.unseen_mass});
  }
  if (progress.done) {
    planner_.best_plan(plan_);
    shown_plan_.write(plan_);
    plan_ready_ = true;
    record(EventKind::kPlanReady, 0, progress.generation);
  }
}

void ControlLoop::publish() noexcept {
  const bool given_up = mode_ == Mode::kFault && (!fault_waits_ || stop_cause_ != StopCause::kNone);
  const bool ended = mode_ == Mode::kDone || given_up;
  finished_ = ended && (wheels_.off || now_ - ended_ > kGiveUp);

  ++counters_.cycles;
  counters_.bus = bus_.counters();
  counters_.refused_frames = bus_.refused();
  counters_.malformed_frames = drives_.malformed();
  counters_.refused_commands = 0;
  for (int reason = 1; reason < kRefusals; ++reason) {
    counters_.refused_commands += gate_.refused(static_cast<Refusal>(reason));
  }

  LoopStatus status;
  status.at = now_;
  status.mode = mode_;
  status.plan_ready = plan_ready_;
  status.finished = finished_;
  status.power_off = wheels_.off;
  status.planning = planner_.progress();
  status.robot = odometry_.pose();
  for (int agent = 0; agent < search_.agents(); ++agent) {
    status.tracks[static_cast<std::size_t>(agent)] = search_.track(agent);
  }
  status.search = search_.state();
  status.search_started = search_started_;
  status.finder = search_.finder();
  status.search_time = search_.elapsed();
  status.stop_cause = stop_cause_;
  status.drives = wheels_.state;
  status.drive_fault = wheels_.fault;
  status.stop_held = stop_held_;
  status.counters = counters_;
  status_.write(status);
}

void ControlLoop::record(EventKind kind, std::uint8_t agent, std::int32_t code, Point place) noexcept {
  (void)events_.push({now_, kind, agent, code, place.x_m, place.y_m});  // a loss is counted by the ring
}

}  // namespace ivo::firmware
