#include "firmware/loop/control_loop.hpp"

#include <algorithm>
#include <chrono>

#include "config/rates.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;

constexpr Duration kPositionEvery = 200ms;  // in the event log
constexpr int kLongestStep = 2;             // cycles: a late one must not let the velocity jump

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
    : tracer_(setup.tracer != nullptr ? *setup.tracer : no_tracer_),
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
      overruns_(setup.robot.loop, setup.overruns_count_only),
      watch_(setup.stopwatch, tracer_),
      search_(planner.cells(), setup.searchers),
      object_(setup.object),
      start_(setup.start),
      stands_(setup.start),
      cycle_(setup.robot.cycle),
      longest_step_(kLongestStep * setup.robot.cycle),
      fault_waits_(setup.fault_waits),
      real_time_(setup.real_time && setup.stopwatch != nullptr),
      beat_timeout_(setup.robot.loop.beat_timeout),
      slices_(planner, events_, tracer_) {
  if (setup.resumed != nullptr) {
    take_up(*setup.resumed);
  }
  odometry_.reset(stands_);
}

// The plan is there, everybody stands where they were left. What follows is as after planning: drives, then consent.
void ControlLoop::take_up(const ResumedSearch& resumed) noexcept {
  slices_.take_over(resumed.plan);
  if (resumed.started) {
    stands_ = resumed.robot;
    left_off_m_ = resumed.distance_left_m;
    slices_.follow();
    search_.resume(slices_.plan(), object_, resumed.progress);
  }
}

void ControlLoop::open(Instant now) noexcept {
  now_ = now;
  drives_.open(now);
}

void ControlLoop::cycle(const CycleStart& start) noexcept {
  watch_.begin();
  tracer_.cycle_began(start.now, watch_.began(), start.woke_late, start.skipped);
  judge_time(start);
  take_commands();
  drain_bus();
  look_at_drives();
  look_for_object();
  decide_mode();
  write(choose_velocity());
  think(start);
  publish();
  watch_.end(start.woke_late);
  tracer_.cycle_ended();
}

void ControlLoop::judge_time(const CycleStart& start) noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kJudgeTime);
  // By the loop's own clock: one that overslept sees it at once, and the phase is kept, so it counts each period once.
  const std::int64_t lost = std::max<std::int64_t>(0, (start.now - now_ + cycle_ / 2) / cycle_ - 1);
  dt_ = std::min(start.now - now_, longest_step_);
  now_ = start.now;
  const Lateness lateness = overruns_.judge(lost, permissions(mode_).may_move);
  if (start.skipped > 0) {
    counters_.skipped += static_cast<std::uint64_t>(start.skipped);
    record(EventKind::kOverrun, static_cast<std::uint8_t>(lateness), static_cast<std::int32_t>(start.skipped));
  }
  if (lateness == Lateness::kLatched) {
    fail({.reason = drivers::DriveFaultReason::kCycleLate, .code = static_cast<std::uint32_t>(lost)});
  }
}

void ControlLoop::take_commands() noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kTakeCommands);
  consent_ = false;
  clear_asked_ = false;
  pause_asked_ = false;
  if (stop_requested_.load(std::memory_order_relaxed)) {
    stop_for(StopCause::kAsked);
  }
  if (const PauseCause cause = pause_requested_.exchange(PauseCause::kNone, std::memory_order_relaxed);
      cause != PauseCause::kNone) {
    pause(cause);
  }
  for (OperatorCommand command; commands_.pop(command);) {
    take(command);
  }
  watch_beats();
}

void ControlLoop::take(const OperatorCommand& command) noexcept {
  switch (command.kind) {
    case OperatorCommand::kConsent:
      agree(command);
      break;
    case OperatorCommand::kClearFault:
      clear_asked_ = mode_ == Mode::kFault;
      break;
    case OperatorCommand::kNoConsent:
      stop_for(StopCause::kNoConsent);
      break;
    case OperatorCommand::kPlanNotKept:
      stop_for(StopCause::kPlanNotKept);
      break;
    case OperatorCommand::kPlanAnew:
      if (mode_ != Mode::kStopping && mode_ != Mode::kDone && mode_ != Mode::kFault) {
        slices_.hold();
        pause(PauseCause::kReplan);
      }
      break;
    case OperatorCommand::kPlanWith:
      slices_.begin_anew(*command.planner);
      search_.look_through(command.planner->cells());
      record(EventKind::kPlanAsked, 0, static_cast<std::int32_t>(slices_.number()));
      break;
    case OperatorCommand::kPlanAsBefore:
      slices_.go_back();
      break;
    case OperatorCommand::kEnough:
      slices_.end_here(now_);
      break;
    case OperatorCommand::kFound:
      if (search_.found_by(command.agent)) {
        record_find();
      }
      break;
    case OperatorCommand::kReport:
      search_.report(command.agent, command.place, now_);
      break;
  }
}

// Who agreed before a pause has not agreed to go on after it. Who agrees is there.
void ControlLoop::agree(const OperatorCommand& consent) noexcept {
  const bool of_now = consent.pauses == pauses_ && (consent.times_ready == 0 || consent.times_ready == times_ready_);
  if (mode_ == Mode::kAwaitingConsent && of_now) {
    consent_ = true;
    watched_ = consent.watched;
    beat_at_ = now_;
  }
}

void ControlLoop::stop_for(StopCause cause) noexcept {
  if (stop_cause_ == StopCause::kNone) {
    stop_cause_ = cause;
    record(EventKind::kStopAsked, 0, static_cast<std::int32_t>(cause));
  }
}

// The robot moves by the consent of somebody who is to be there.
void ControlLoop::watch_beats() noexcept {
  const std::uint32_t beats = beats_.load(std::memory_order_relaxed);
  if (beats != beats_heard_) {
    beats_heard_ = beats;
    beat_at_ = now_;
  }
  if (watched_ && mode_ == Mode::kSearching && (!beat_at_ || now_ - *beat_at_ > beat_timeout_)) {
    pause(PauseCause::kBeatLost);
  }
}

void ControlLoop::pause(PauseCause cause) noexcept {
  pause_asked_ = true;
  consent_ = false;
  ++pauses_;
  if (mode_ == Mode::kSearching) {
    pause_cause_ = cause;
    record(EventKind::kPaused, 0, static_cast<std::int32_t>(cause));
  }
}

void ControlLoop::drain_bus() noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kDrainBus);
  const std::size_t received = bus_.receive(frames_, now_);
  for (std::size_t i = 0; i < received; ++i) {
    drives_.on_frame(frames_[i]);
  }
  if (bus_.state() != counters_.bus_state) {
    counters_.bus_state = bus_.state();
    record(EventKind::kBusState, 0, static_cast<std::int32_t>(counters_.bus_state));
    tracer_.bus_state(static_cast<std::uint8_t>(counters_.bus_state));
  }
}

void ControlLoop::look_at_drives() noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kLookAtDrives);
  look_at_stop_inputs();
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

void ControlLoop::fail(const drivers::DriveFault& fault) noexcept {
  drives_.fail(fault, now_);
  wheels_ = drives_.feedback();
}

void ControlLoop::look_for_object() noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kLookForObject);
  // A fault of the robot that waits to be cleared does not keep the others from searching.
  const bool others_go_on = fault_waits_ && mode_ != Mode::kStopping && mode_ != Mode::kDone;
  if (!search_started_ || (mode_ != Mode::kSearching && !others_go_on) || search_.state() != SearchState::kRunning) {
    return;
  }
  // Who waits for another plan has not come to the end of the last one.
  const bool plan_stands = slices_.ready() && !slices_.newer();
  search_.update(now_, odometry_.pose().point(), following_.reached, plan_stands);
  if (search_.state() == SearchState::kFound) {
    record_find();
  } else if (search_.state() == SearchState::kPathsEnded) {
    record(EventKind::kPathsEnded);
  }
  if (now_ >= next_position_) {
    next_position_ = now_ + kPositionEvery;
    for (int agent = 0; agent < search_.agents(); ++agent) {
      if (!search_.present(agent)) {
        continue;
      }
      record(EventKind::kPosition, static_cast<std::uint8_t>(agent), 0, search_.track(agent).position);
    }
  }
}

void ControlLoop::record_find() noexcept {
  const int finder = *search_.finder();
  record(EventKind::kFound, static_cast<std::uint8_t>(finder), 0,
         object_.place().value_or(search_.track(finder).position));
}

void ControlLoop::decide_mode() noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kDecideMode);
  using drivers::GroupState;
  const bool enabled = wheels_.state == GroupState::kEnabled;
  const bool stop_held = stop_held_.reason != drivers::DriveFaultReason::kNone;
  const Mode before = mode_;
  mode_ = mode_machine_.update(
      {
          .plan_ready = slices_.ready(),
          .consent_given = consent_,
          .stop_asked = stop_cause_ != StopCause::kNone,
          .pause_asked = pause_asked_,
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
  if (mode_ != before || counters_.cycles == 0) {
    tracer_.mode(static_cast<std::uint8_t>(mode_));
  }
  if (mode_ == Mode::kSearching && enabled && !search_started_) {
    begin_search();
  } else if (mode_ == Mode::kSearching && enabled && slices_.newer()) {
    take_new_plan();
  }
  if (before == Mode::kFault && mode_ != before) {
    record(EventKind::kFaultCleared);
  }
}

void ControlLoop::enter(Mode mode) noexcept {
  record(EventKind::kMode, 0, static_cast<std::int32_t>(mode));
  times_ready_ += mode == Mode::kAwaitingConsent ? 1 : 0;
  if (mode == Mode::kSearching) {
    consented_ = true;
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
  odometry_.reset(stands_);
  limiter_.reset();
  const bool new_plan = slices_.newer();
  slices_.follow();
  const auto path = slices_.plan().paths[0].waypoints.span();
  if (left_off_m_ && new_plan) {
    (void)follower_.start(path, stands_);
    search_.go_on(now_);
    search_.follow(slices_.plan());
  } else if (left_off_m_) {
    (void)follower_.resume(path, stands_, start_.heading_rad, *left_off_m_);
    search_.go_on(now_);
  } else {
    (void)follower_.start(path, stands_);
    search_.start(now_, slices_.plan(), object_);
  }
  next_position_ = now_;
  record(EventKind::kSearchStarted);
}

// Under way, and from a standstill: everybody goes to where the new paths begin.
void ControlLoop::take_new_plan() noexcept {
  slices_.follow();
  limiter_.reset();
  (void)follower_.start(slices_.plan().paths[0].waypoints.span(), odometry_.pose());
  search_.follow(slices_.plan());
  record(EventKind::kPlanTaken, 0, static_cast<std::int32_t>(slices_.number()));
}

Twist ControlLoop::choose_velocity() noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kChooseVelocity);
  return pass_gate(clamp(follow()));
}

Twist ControlLoop::follow() noexcept {
  if (mode_ != Mode::kSearching || !search_started_ || wheels_.state != drivers::GroupState::kEnabled) {
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
  if (ramps_down(mode_) || overruns_.lateness() == Lateness::kRampDown) {
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
  const PhaseWatch::Lap lap(watch_, Phase::kWrite);
  const bool enable = permissions(mode_).enable_drives;
  bus_.permit_motion(enable);
  told_ = kinematics_.wheel_speeds(passed);
  drives_.write(now_, enable, {told_});
  moving_ = passed;
}

// Late in the cycle, in what is left of it: SYNC and targets never wait for a thought.
void ControlLoop::think(const CycleStart& start) noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kThink);
  if (!permissions(mode_).think || slices_.ready()) {
    return;
  }
  const Instant until = watch_.began() - start.woke_late + cycle_ * rates::kThinkUntilPercent / 100;
  slices_.run(now_, real_time_ ? watch_.stopwatch() : nullptr, until);
}

}  // namespace ivo::firmware
