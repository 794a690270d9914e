// The robot, one cycle at a time. control_loop.cpp is its table of contents; every line there is a file. What it tells
// the rest of the program is in control_loop_report.cpp.
#pragma once

#include <array>
#include <atomic>
#include <optional>

#include "config/base/latest.hpp"
#include "config/base/realtime.hpp"
#include "config/base/spsc_ring.hpp"
#include "config/robot.hpp"
#include "drivers/drive_group.hpp"
#include "firmware/loop/loop_status.hpp"
#include "firmware/loop/overrun_policy.hpp"
#include "firmware/loop/phase_times.hpp"
#include "firmware/loop/planner_slices.hpp"
#include "firmware/mission/resumed_search.hpp"
#include "firmware/mission/search_run.hpp"
#include "firmware/motion/kinematics.hpp"
#include "firmware/motion/limiter.hpp"
#include "firmware/motion/odometry.hpp"
#include "firmware/motion/path_follower.hpp"
#include "firmware/record/event.hpp"
#include "firmware/record/tracer.hpp"
#include "firmware/safety/command_gate.hpp"
#include "firmware/safety/guarded_bus.hpp"
#include "firmware/safety/mode.hpp"
#include "firmware/safety/stop_inputs.hpp"
#include "firmware/safety/wheel_monitor.hpp"
#include "hal/api/digital_io.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware {

struct LoopSetup {
  Robot robot;
  Pose start;           ///< of the robot, agent 0
  Searchers searchers;  ///< agent 0 is the robot
  SearchObject object;
  /// A fault does not finish the loop: somebody is there to clear it or to ask for a stop.
  bool fault_waits = false;
  /// Where the robot has stop inputs (robot.inputs); outlives the loop. Inputs that nobody reads count as pressed.
  hal::DigitalInputs* inputs = nullptr;
  /// What phases are measured with; none: nothing is measured. Outlives the loop.
  hal::Clock* stopwatch = nullptr;
  /// Where what cycles do is traced, by that stopwatch; none: nowhere. Outlives the loop.
  Tracer* tracer = nullptr;
  /// Time is real, and `stopwatch` its clock: the planner's slices are sized by what work has cost, not by count alone.
  bool real_time = false;
  /// Lost periods are counted and nothing else: the bus is simulated, and a busy host says nothing about a robot.
  bool overruns_count_only = false;
  /// A search that is taken up instead of planned; only the constructor looks at it.
  const ResumedSearch* resumed = nullptr;
};

/// When a cycle runs, by the one who calls it.
struct CycleStart {
  Instant now{};
  std::int64_t skipped = 0;  ///< periods lost before it
  Duration woke_late{};      ///< from its deadline to `now`; of real time alone
};

class ControlLoop {
 public:
  /// `planner` is prepared; both outlive this.
  ControlLoop(const LoopSetup& setup, planner::Planner& planner, hal::CanBus& bus) noexcept;

  /// Before the first cycle: the drives begin to start up. Nothing moves.
  void open(Instant now) noexcept;

  /// One cycle. Never waits, allocates or throws. Cost: some microseconds and, while planning, the planner's share
  /// (planner_slices.hpp), in real time up to rates::kThinkUntilPercent of the period.
  void cycle(const CycleStart& start) noexcept IVO_REALTIME;

  /// Drives off, or given up: no cycle is needed any more.
  [[nodiscard]] bool finished() const noexcept { return finished_; }
  /// For lock-step time: frames that the drives owe us outside of SYNC.
  [[nodiscard]] int answers_awaited() const noexcept { return drives_.answers_awaited(); }
  /// Ditto: the COB-ID of the TPDO with which a drive answers SYNC.
  [[nodiscard]] std::uint16_t feedback_id(Wheel wheel) const noexcept {
    return drives_.drive(wheel).channels().feedback_id;
  }

  /// From any thread and from a signal handler: the robot ramps down, the run ends.
  void request_stop() noexcept { stop_requested_.store(true, std::memory_order_relaxed); }

  /// From any thread: the robot ramps down and stands until somebody consents anew. Where it does not move, an answer
  /// that is on its way is void.
  void request_pause(PauseCause cause = PauseCause::kAsked) noexcept {
    pause_requested_.store(cause, std::memory_order_relaxed);
  }
  /// From any thread: whoever consented is there (OperatorCommand::watched).
  void beat() noexcept { beats_.fetch_add(1, std::memory_order_relaxed); }

  // To and from one other thread.
  bool command(OperatorCommand command) noexcept { return commands_.push(command); }
  [[nodiscard]] const LoopStatus& status() noexcept { return status_.read(); }
  /// The plan; valid once a status has shown plan_ready.
  [[nodiscard]] const planner::Plan& plan() noexcept { return slices_.shown().plan; }
  /// The same, or the best so far.
  [[nodiscard]] const ShownPlan& shown_plan() noexcept { return slices_.shown(); }
  [[nodiscard]] EventRing& events() noexcept { return events_; }
  /// Cycles so far, from any thread: what a watchdog looks at.
  [[nodiscard]] std::uint64_t cycles() const noexcept { return cycles_.load(std::memory_order_relaxed); }
  /// Work of the planner so far (planner/search/search.hpp); for the loop's own thread.
  [[nodiscard]] std::int64_t planner_units() const noexcept { return slices_.units(); }
  /// What they cost; for the loop's own thread, or once it has ended.
  [[nodiscard]] const PhaseTimes& times() const noexcept { return watch_.times(); }

 private:
  // The phases.
  void judge_time(const CycleStart& start) noexcept;
  void take_commands() noexcept;
  void take(const OperatorCommand& command) noexcept;
  void agree(const OperatorCommand& consent) noexcept;
  void stop_for(StopCause cause) noexcept;
  void watch_beats() noexcept;
  void pause(PauseCause cause) noexcept;
  void drain_bus() noexcept;
  void look_at_drives() noexcept;
  void look_for_object() noexcept;
  void decide_mode() noexcept;
  [[nodiscard]] Twist choose_velocity() noexcept;
  void write(const Twist& passed) noexcept;
  void think(const CycleStart& start) noexcept;
  void publish() noexcept;

  // What they are made of.
  void look_at_stop_inputs() noexcept;
  [[nodiscard]] Twist follow() noexcept;
  [[nodiscard]] Twist clamp(const Twist& wanted) noexcept;
  [[nodiscard]] Twist pass_gate(const Twist& limited) noexcept;
  [[nodiscard]] double distance_left_m() const noexcept;
  void count() noexcept;
  void take_up(const ResumedSearch& resumed) noexcept;
  void begin_search() noexcept;
  void take_new_plan() noexcept;
  void record_fault() noexcept;
  void record_find() noexcept;
  void trace_motion() noexcept;
  void fail(const drivers::DriveFault& fault) noexcept;
  void enter(Mode mode) noexcept;
  void record(EventKind kind, std::uint8_t agent = 0, std::int32_t code = 0, Point place = {}) noexcept;

  Tracer no_tracer_;
  Tracer& tracer_;
  GuardedBus bus_;
  drivers::DriveGroup drives_;
  Kinematics kinematics_;
  Odometry odometry_;
  Limiter limiter_;
  PathFollower follower_;
  CommandGate gate_;
  WheelMonitor monitor_;
  StopInputs stop_inputs_;
  hal::DigitalInputs* inputs_;
  ModeMachine mode_machine_;
  OverrunPolicy overruns_;
  PhaseWatch watch_;
  SearchRun search_;
  SearchObject object_;
  Pose start_;
  Pose stands_;  // until it moves
  Duration cycle_;
  Duration longest_step_;
  bool fault_waits_;
  bool real_time_;

  // Of the cycle under way.
  Instant now_{};
  Duration dt_{};
  drivers::GroupFeedback wheels_;
  Instant feedback_at_{};
  Mode mode_ = Mode::kPlanning;
  drivers::DriveFaultReason fault_recorded_ = drivers::DriveFaultReason::kNone;
  bool turning_recorded_ = false;

  Twist moving_;                     // last sent
  WheelValues told_{};               // rad/s, of that
  drivers::DriveFault stop_held_{};  // an input is pressed
  PathFollower::Output following_;
  std::uint32_t times_ready_ = 0;
  bool consent_ = false;
  bool clear_asked_ = false;
  bool pause_asked_ = false;
  bool watched_ = false;
  std::uint32_t pauses_ = 0;
  PauseCause pause_cause_ = PauseCause::kNone;
  std::uint32_t beats_heard_ = 0;
  std::optional<Instant> beat_at_;
  Duration beat_timeout_;
  bool consented_ = false;
  bool search_started_ = false;
  std::optional<double> left_off_m_;  // of the path, by the run that this one takes up
  StopCause stop_cause_ = StopCause::kNone;
  Instant ended_{};
  Instant next_position_{};
  bool finished_ = false;
  LoopCounters counters_;
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames_{};

  Latest<LoopStatus> status_;
  SpscRing<OperatorCommand, 64> commands_;
  std::atomic<PauseCause> pause_requested_{PauseCause::kNone};
  std::atomic<std::uint32_t> beats_{0};
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
  std::atomic<bool> stop_requested_{false};
  static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
  std::atomic<std::uint64_t> cycles_{0};
  EventRing events_;
  PlannerSlices slices_;
};

}  // namespace ivo::firmware
