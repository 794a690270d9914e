// The robot, one cycle at a time. control_loop.cpp is its table of contents; every line there is a file.
#pragma once

#include <array>
#include <atomic>

#include "config/base/latest.hpp"
#include "config/base/spsc_ring.hpp"
#include "config/robot.hpp"
#include "drivers/drive_group.hpp"
#include "firmware/loop/loop_status.hpp"
#include "firmware/mission/search_run.hpp"
#include "firmware/motion/kinematics.hpp"
#include "firmware/motion/limiter.hpp"
#include "firmware/motion/odometry.hpp"
#include "firmware/motion/path_follower.hpp"
#include "firmware/record/event.hpp"
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
};

class ControlLoop {
 public:
  /// `planner` is prepared; both outlive this.
  ControlLoop(const LoopSetup& setup, planner::Planner& planner, hal::CanBus& bus) noexcept;

  /// Before the first cycle: the drives begin to start up. Nothing moves.
  void open(Instant now) noexcept;

  /// One cycle. `skipped`: periods lost before it. Never waits, allocates or throws. Cost: the planner's share
  /// (rates::kPlannerUnitsPerCycle units while planning) and some microseconds; in the cycle in which the plan is
  /// ready, its copies.
  void cycle(Instant now, std::int64_t skipped) noexcept;

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

  // To and from one other thread.
  bool command(OperatorCommand command) noexcept { return commands_.push(command); }
  [[nodiscard]] const LoopStatus& status() noexcept { return status_.read(); }
  /// The plan; valid once a status has shown plan_ready.
  [[nodiscard]] const planner::Plan& plan() noexcept { return shown_plan_.read(); }
  [[nodiscard]] EventRing& events() noexcept { return events_; }

 private:
  void take_commands() noexcept;
  void drain_bus() noexcept;
  void look_at_drives() noexcept;
  void look_at_stop_inputs() noexcept;
  void look_at_ourselves(std::int64_t skipped, std::int64_t late) noexcept;
  void look_for_object() noexcept;
  void decide_mode() noexcept;
  [[nodiscard]] Twist choose_velocity() noexcept;
  [[nodiscard]] Twist clamp(const Twist& wanted) noexcept;
  [[nodiscard]] Twist pass_gate(const Twist& limited) noexcept;
  void write(const Twist& passed) noexcept;
  void think() noexcept;
  void think_a_slice(planner::Budget budget) noexcept;
  void publish() noexcept;

  void begin_search() noexcept;
  void record_fault() noexcept;
  void fail(const drivers::DriveFault& fault) noexcept;
  void enter(Mode mode) noexcept;
  void record(EventKind kind, std::uint8_t agent = 0, std::int32_t code = 0, Point place = {}) noexcept;

  planner::Planner& planner_;
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
  SearchRun search_;
  SearchObject object_;
  Pose start_;
  Duration cycle_;
  Duration longest_step_;
  std::int64_t lateness_ = 0;  // kForgetPeriodIn for each lost period, one less each cycle
  bool fault_waits_;

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
  bool plan_ready_ = false;
  bool consent_ = false;
  bool clear_asked_ = false;
  bool search_started_ = false;
  StopCause stop_cause_ = StopCause::kNone;
  Instant ended_{};
  Instant next_position_{};
  bool finished_ = false;
  LoopCounters counters_;
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames_{};

  planner::Plan plan_;
  Latest<planner::Plan> shown_plan_;
  Latest<LoopStatus> status_;
  SpscRing<OperatorCommand, 16> commands_;
  std::atomic<bool> stop_requested_{false};
  static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
  EventRing events_;
};

}  // namespace ivo::firmware
