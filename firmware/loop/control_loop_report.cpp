// What the loop tells the rest of the program: its status, its events, its trace.
#include "config/rates.hpp"
#include "firmware/loop/control_loop.hpp"

namespace ivo::firmware {
namespace {

// After this long in an end mode nobody waits for the drives any more: they stop by our missing heartbeat.
constexpr Duration kGiveUp = rates::kStandstillTimeout + rates::kStateChangeTimeout;

}  // namespace

void ControlLoop::publish() noexcept {
  const PhaseWatch::Lap lap(watch_, Phase::kPublish);
  const bool given_up = mode_ == Mode::kFault && (!fault_waits_ || stop_cause_ != StopCause::kNone);
  const bool ended = mode_ == Mode::kDone || given_up;
  finished_ = ended && (wheels_.off || now_ - ended_ > kGiveUp);

  count();
  LoopStatus status;
  status.at = now_;
  status.mode = mode_;
  status.plan_ready = slices_.ready();
  status.plan_number = slices_.number();
  status.preparing = slices_.held();
  status.finished = finished_;
  status.power_off = wheels_.off;
  status.planning = slices_.progress();
  status.robot = odometry_.pose();
  for (int agent = 0; agent < search_.agents(); ++agent) {
    AgentTrack& track = status.tracks[static_cast<std::size_t>(agent)];
    track = search_.track(agent);
    track.before_m = slices_.newer() ? track.moved_m : track.before_m;
    status.report_age[static_cast<std::size_t>(agent)] = search_.report_age(agent, now_);
  }
  status.search = search_.state();
  status.search_started = search_started_ || left_off_m_;
  status.consented = consented_;
  status.distance_left_m = distance_left_m();
  status.way_of_plan = slices_.newer() ? slices_.number() : slices_.followed_number();
  status.way_followed = !slices_.newer() && slices_.followed_number() > 0;
  status.finder = search_.finder();
  status.search_time = search_.elapsed();
  status.stop_cause = stop_cause_;
  status.pauses = pauses_;
  status.pause_cause = pause_cause_;
  status.watched = watched_;
  if (beat_at_) {
    status.beat_age = now_ - *beat_at_;
  }
  status.drives = wheels_.state;
  status.drive_fault = wheels_.fault;
  status.stop_held = stop_held_;
  status.times_ready = times_ready_;
  status.lateness = overruns_.lateness();
  status.counters = counters_;
  status_.write(status);
  trace_motion();
}

// Of a plan that nobody has set off on: all of it.
double ControlLoop::distance_left_m() const noexcept {
  if (slices_.newer() && (search_started_ || left_off_m_)) {
    return slices_.plan().paths[0].length_m;
  }
  return search_started_ ? following_.distance_left_m : left_off_m_.value_or(0.0);
}

void ControlLoop::count() noexcept {
  cycles_.store(++counters_.cycles, std::memory_order_relaxed);
  counters_.bus = bus_.counters();
  counters_.refused_frames = bus_.refused();
  counters_.malformed_frames = drives_.malformed();
  counters_.refused_commands = 0;
  for (int reason = 1; reason < kRefusals; ++reason) {
    counters_.refused_commands += gate_.refused(static_cast<Refusal>(reason));
  }
}

void ControlLoop::trace_motion() noexcept {
  if (!tracer_.on()) {
    return;
  }
  tracer_.pose(0, odometry_.pose());
  for (int agent = 1; search_started_ && agent < search_.agents(); ++agent) {
    const Point place = search_.track(agent).position;
    tracer_.pose(static_cast<std::uint16_t>(agent), {place.x_m, place.y_m, 0.0});
  }
  tracer_.command(moving_);
  tracer_.wheels(told_, wheels_.angle_rad);
}

void ControlLoop::record_fault() noexcept {
  const drivers::DriveFault& fault = wheels_.fault;
  if (wheels_.state == drivers::GroupState::kFault && fault.reason != fault_recorded_) {
    record(EventKind::kDriveFault, static_cast<std::uint8_t>(fault.wheel), static_cast<std::int32_t>(fault.reason));
    tracer_.fault(static_cast<std::uint8_t>(fault.reason), static_cast<std::uint16_t>(fault.wheel),
                  {.node_id = fault.node_id, .code = fault.code});
  }
  if (fault.turning_node_id != 0 && !turning_recorded_) {
    record(EventKind::kDriveFault, static_cast<std::uint8_t>(fault.turning_wheel),
           static_cast<std::int32_t>(drivers::DriveFaultReason::kNotStill));
  }
  turning_recorded_ = fault.turning_node_id != 0;
  fault_recorded_ = wheels_.state == drivers::GroupState::kFault ? fault.reason : drivers::DriveFaultReason::kNone;
}

void ControlLoop::record(EventKind kind, std::uint8_t agent, std::int32_t code, Point place) noexcept {
  (void)events_.push({now_, kind, agent, code, place.x_m, place.y_m});  // a loss is counted by the ring
}

}  // namespace ivo::firmware
