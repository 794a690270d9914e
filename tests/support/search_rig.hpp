// A whole robot in one process: planner, control loop, virtual bus and simulated drives on a 12 x 12 m plaza, cycle by
// cycle.
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "config/rates.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "firmware/loop/control_loop.hpp"
#include "hal/api/digital_io.hpp"
#include "hal/sim/virtual_bus.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/heap_trap.hpp"

namespace ivo::test {

class SearchRig {
 public:
  struct Options {
    std::optional<Point> object{};
    drivers::SimDrives::Scripts scripts{};
    int generations = 3;
    bool fault_waits = false;
    /// What the loop is given in the place of its port of the bus; none: the port itself.
    std::function<hal::CanBus&(hal::CanBus&)> between{};
    /// With them the robot has an emergency stop (input 0) and a bumper (input 1).
    hal::DigitalInputs* inputs = nullptr;
    /// kShared: at 1 kHz.
    PdoLayout layout = PdoLayout::kOwn;
    bool overruns_count_only = false;
    /// Phases are measured with it, and the planner's slices sized by it.
    hal::Clock* stopwatch = nullptr;
    /// Cycles are traced, by a clock that sizes nothing.
    firmware::Tracer* tracer = nullptr;
    hal::Clock* trace_stopwatch = nullptr;
    const firmware::ResumedSearch* resumed = nullptr;
    PersonMotion person = PersonMotion::kSimulated;
  };

  explicit SearchRig(const Options& options)
      : robot_(robot(options.layout)),
        drives_(bus_.port(1), robot_, drivers::SimDrives::TimeFrom::kClock, options.scripts) {
    prepare(planner(), options.generations, {Point{1.5, 1.5}, Point{10.5, 1.5}});
    firmware::LoopSetup setup{.robot = robot_, .start = {1.5, 1.5, 0.0}, .searchers = {}, .object = {}};
    (void)setup.searchers.push_back({.kind = AgentKind::kRobot, .start = {1.5, 1.5}, .speed_mps = 0.5});
    (void)setup.searchers.push_back(
        {.kind = AgentKind::kPerson, .motion = options.person, .start = {10.5, 1.5}, .speed_mps = 0.5});
    setup.fault_waits = options.fault_waits;
    setup.overruns_count_only = options.overruns_count_only;
    setup.stopwatch = options.stopwatch != nullptr ? options.stopwatch : options.trace_stopwatch;
    setup.tracer = options.tracer;
    setup.resumed = options.resumed;
    setup.real_time = options.stopwatch != nullptr;
    if (options.inputs != nullptr) {
      setup.robot.inputs = {.chip = "gpiochip0", .emergency_stop = InputLine{}, .bumpers = {InputLine{}}};
      setup.inputs = options.inputs;
    }
    if (options.object) {
      setup.object = firmware::SearchObject(*options.object, FindRule::kSight);
    }
    loop_ = std::make_unique<firmware::ControlLoop>(setup, planner(),
                                                    options.between ? options.between(bus_.port(0)) : bus_.port(0));
    drives_.open();
    loop_->open(now_);
  }

  /// One cycle, then the drives answer and a period passes.
  const firmware::LoopStatus& cycle(std::int64_t skipped = 0) {
    {
      const NoHeap no_heap;  // of every cycle of every test, in the preset noheap
      loop_->cycle({.now = now_, .skipped = skipped});
    }
    drives_.update(now_);
    now_ += robot_.cycle;
    true_position_.x_m += velocity({1, 1, 1, 1}) * seconds(robot_.cycle);
    true_position_.y_m += velocity({-1, 1, 1, -1}) * seconds(robot_.cycle);
    return loop_->status();
  }
  /// A cycle that comes `periods` too late, and is told so.
  const firmware::LoopStatus& late_cycle(int periods) {
    be_late(periods);
    return cycle(periods);
  }
  /// A cycle that wakes at `at`, in phase or not; the drives have answered in every period until then.
  const firmware::LoopStatus& cycle_at(Instant at, std::int64_t skipped) {
    for (; now_ + robot_.cycle <= at; now_ += robot_.cycle) {
      drives_.update(now_);
    }
    loop_->cycle({.now = at, .skipped = skipped});
    return loop_->status();
  }
  /// The loop oversleeps; the drives do not.
  void sleep(Duration time) {
    for (const Instant end = now_ + time; now_ < end; now_ += robot_.cycle) {
      drives_.update(now_);
    }
  }
  /// `periods` pass before the next cycle, without one.
  void be_late(int periods) {
    for (; periods > 0; --periods) {
      drives_.update(now_);
      now_ += robot_.cycle;
    }
  }
  void run(Duration time) {
    for (const Instant end = now_ + time; now_ < end;) {
      cycle();
    }
  }
  /// False when the mode did not come within `limit`.
  bool run_until(firmware::Mode mode, Duration limit = std::chrono::seconds(600)) {
    for (const Instant end = now_ + limit; now_ < end;) {
      if (cycle().mode == mode) {
        return true;
      }
    }
    return false;
  }
  bool start_search() {
    if (!run_until(firmware::Mode::kAwaitingConsent)) {
      return false;
    }
    return consent() && run_until(firmware::Mode::kSearching, std::chrono::seconds(1));
  }
  /// Somebody agrees to what is shown now.
  bool consent(bool watched = false) {
    firmware::OperatorCommand consent(firmware::OperatorCommand::kConsent);
    consent.watched = watched;
    consent.pauses = loop_->status().pauses;
    return loop_->command(consent);
  }
  /// Somebody wants another plan, which is made ready: of so many generations, from where everybody is once the robot
  /// stands.
  bool plan_anew(int generations) {
    if (!loop_->command(firmware::OperatorCommand::kPlanAnew)) {
      return false;
    }
    do {
      cycle();
    } while (!loop_->status().preparing || firmware::permissions(loop_->status().mode).may_move);
    return plan_with(generations);
  }
  /// The loop has heard that a plan is to be made anew, and the robot stands.
  bool plan_with(int generations) {
    const auto& tracks = loop_->status().tracks;
    planner::Planner& other = thinking_ == &planner() ? spare_planner() : planner();
    prepare(other, generations, {tracks[0].position, tracks[1].position});
    firmware::OperatorCommand with(firmware::OperatorCommand::kPlanWith);
    with.planner = &other;
    thinking_ = &other;
    return loop_->command(with);
  }
  /// True while any simulated wheel turns.
  bool wheels_turn() {
    for (int i = 0; i < kWheels; ++i) {
      if (drives_.drive(static_cast<Wheel>(i)).motion().velocity() != 0) {
        return true;
      }
    }
    return false;
  }
  /// Of the base, from the simulated wheels' own velocities: mecanum kinematics (r vx is the mean, r vy the mean with
  /// signs -, +, +, - over FL, FR, RL, RR), the heading held at 0.
  [[nodiscard]] double speed_mps() { return std::hypot(velocity({1, 1, 1, 1}), velocity({-1, 1, 1, -1})); }
  /// Where these velocities have taken the base.
  [[nodiscard]] Point true_position() const { return true_position_; }
  std::vector<firmware::Event> events() {
    std::vector<firmware::Event> events;
    for (firmware::Event event; loop_->events().pop(event);) {
      events.push_back(event);
    }
    return events;
  }

  firmware::ControlLoop& loop() { return *loop_; }
  drivers::SimDrives& drives() { return drives_; }
  hal::VirtualBus& bus() { return bus_; }
  [[nodiscard]] Instant now() const { return now_; }

  /// The robot of every rig.
  static Robot robot(PdoLayout layout = PdoLayout::kOwn) {
    Robot robot;
    robot.name = "test base";
    robot.pdo_layout = layout;
    robot.cycle = layout == PdoLayout::kShared ? rates::kShortestCycle : rates::kCycle;
    for (std::size_t i = 0; i < robot.drives.size(); ++i) {
      robot.drives[i].node_id = static_cast<std::uint8_t>(i + 1);
      robot.drives[i].sign = i % 2 == 0 ? 1 : -1;
      robot.drives[i].gear_ratio = 20.0;
    }
    return robot;
  }

 private:
  double velocity(const std::array<int, kWheels>& signs) {
    double sum = 0.0;
    for (std::size_t i = 0; i < signs.size(); ++i) {
      const DriveParameters& drive = robot_.drives[i];
      const double units = drives_.drive(static_cast<Wheel>(i)).motion().velocity();
      sum += signs[i] * units * drive.sign / (drive.velocity_per_radps * drive.gear_ratio);
    }
    return robot_.base.wheel_radius_m * sum / 4;
  }
  // One for the program: it is large; and another, for plans that are made anew.
  static planner::Planner& planner() {
    static planner::Planner planner;
    return planner;
  }
  static planner::Planner& spare_planner() {
    static planner::Planner planner;
    return planner;
  }
  static void prepare(planner::Planner& planner, int generations, const std::array<Point, 2>& starts) {
    const DrawnMap map(12, 12, 0.25);
    planner::SearchProblem problem;
    problem.map = map.view();
    problem.graph.spacing_m = 3.0;
    problem.colony.generations = generations;
    for (const Point start : starts) {
      planner::SearchAgent agent;
      agent.body.start = start;
      (void)problem.agents.push_back(agent);
    }
    IVO_CONTRACT(!planner.prepare(problem));
  }

  hal::VirtualBus bus_;
  Robot robot_;
  drivers::SimDrives drives_;
  std::unique_ptr<firmware::ControlLoop> loop_;
  planner::Planner* thinking_ = &planner();
  Instant now_{};
  Point true_position_{1.5, 1.5};
};

}  // namespace ivo::test
