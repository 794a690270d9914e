#include "firmware/tools/bench/can/fault_rig.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "config/rates.hpp"
#include "drivers/canopen/bus_ids.hpp"
#include "firmware/tools/bench/can/tool.hpp"
#include "firmware/tools/planner_object.hpp"

namespace ivo::firmware::bench {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

constexpr double kSide_m = 18.0;
constexpr double kSpacing_m = 3.0;
constexpr double kPixel_m = 0.25;
constexpr double kSpeed_mps = 0.5;
constexpr int kGenerations = 2;
constexpr std::uint32_t kVendorId = 0xAA;  // of all four, and looked at

Robot robot_with(PdoLayout layout) {
  Robot robot;
  for (DriveParameters& drive : robot.drives) {
    drive.vendor_id = kVendorId;
  }
  robot.pdo_layout = layout;
  robot.cycle = layout == PdoLayout::kShared ? rates::kShortestCycle : rates::kCycle;
  robot.inputs.emergency_stop = InputLine{.line = 0};
  robot.inputs.bumpers[0] = InputLine{.line = 1};
  return robot;
}

/// Prepares the program's planner; the plan is of no matter as long as it is long.
Result<LoopSetup> prepare_search(const Robot& robot) {
  static const Scene scene = [] {
    Scene made = open_ground(kSide_m, kSide_m, kPixel_m, kSpacing_m);
    made.problem.colony.generations = kGenerations;
    return made;
  }();
  if (const planner::Refusal refusal = the_planner().prepare(scene.problem); refusal) {
    return Error{"the planner refuses open ground"};
  }
  LoopSetup setup{.robot = robot, .start = {}, .searchers = {}, .object = {}, .fault_waits = true};
  for (std::size_t m = 0; m < scene.problem.agents.size(); ++m) {
    (void)setup.searchers.push_back({.kind = m == 0 ? AgentKind::kRobot : AgentKind::kPerson,
                                     .start = scene.problem.agents[m].body.start,
                                     .speed_mps = kSpeed_mps});
  }
  const Point start = setup.searchers[0].start;
  setup.start = {start.x_m, start.y_m, 0.0};
  return setup;
}

}  // namespace

std::vector<std::string> gateway_rule(const std::string& verb, bool to_drives, const std::vector<std::string>& more) {
  const char* const from = to_drives ? FaultRig::kMasterSide : FaultRig::kOtherSide;
  const char* const to = to_drives ? FaultRig::kOtherSide : FaultRig::kMasterSide;
  std::vector<std::string> words = {"cangw", verb, "-s", from, "-d", to, "-e"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Result<std::unique_ptr<FaultRig>> FaultRig::make(const Options& options) {
  if (options.gateway) {
    for (const std::vector<std::string>& rule :
         {gateway_rule("-A", true, {}), gateway_rule("-A", false, {"-f", "183~7FF"}),
          gateway_rule("-A", false, {"-f", "183:7FF"})}) {
      if (const Result<void> ran = run_tool(rule); !ran) {
        return ran.error();
      }
    }
  }
  const Robot robot = robot_with(options.layout);
  const drivers::BusIds heard = drivers::bus_ids(robot);
  Result<hal::SocketCanBus> master =
      hal::SocketCanBus::open(kMasterSide, {.ids = heard.span(), .receive_bytes = options.receive_bytes});
  Result<hal::SocketCanBus> drives =
      hal::SocketCanBus::open(options.gateway ? kOtherSide : kMasterSide, {.confirm = false});
  Result<Injector> injector = Injector::open(kMasterSide);
  Result<Delivery> delivery = Delivery::open(kOtherSide);
  if (!master || !drives || !injector || !delivery) {
    return !master ? master.error() : !drives ? drives.error() : !injector ? injector.error() : delivery.error();
  }
  stay_on_one_cpu();
  Result<LoopSetup> setup = prepare_search(robot);
  if (!setup) {
    return setup.error();
  }
  std::unique_ptr<FaultRig> rig(new FaultRig(options, robot, std::move(master).value(), std::move(drives).value(),
                                             std::move(injector).value(), std::move(delivery).value()));
  setup.value().inputs = &rig->inputs_;
  rig->loop_ = std::make_unique<ControlLoop>(setup.value(), the_planner(), rig->tap_);
  return rig;
}

FaultRig::FaultRig(const Options& options, const Robot& robot, hal::SocketCanBus master, hal::SocketCanBus drives,
                   Injector injector, Delivery delivery)
    : robot_(robot),
      gateway_(options.gateway),
      master_(std::move(master)),
      tap_(master_),
      drives_bus_(std::move(drives)),
      meddled_(drives_bus_),
      injector_(std::move(injector)),
      delivery_(std::move(delivery)),
      drives_(std::in_place, meddled_, robot_, drivers::SimDrives::TimeFrom::kClock) {
  if (gateway_) {
    at_end({"cangw", "-F"});
  }
}

FaultRig::~FaultRig() {
  for (auto words = undo_.rbegin(); words != undo_.rend(); ++words) {
    (void)run_tool(*words);
  }
}

void FaultRig::power_on() {
  deliver();
  drives_->open();
  loop_->open(now_);
}

const LoopStatus& FaultRig::cycle() {
  if (each_cycle_) {
    each_cycle_(*this);
    deliver();
  }
  for (; late_ > 0; --late_) {
    pass_period();
    ++missed_;
  }
  tap_.clear();
  if (held_) {
    ++missed_;
  } else {
    loop_->cycle({.now = now_, .skipped = std::exchange(missed_, 0)});
  }
  pass_period();
  return loop_->status();
}

void FaultRig::deliver() {
  delivery_.wait();
  if (gateway_) {  // what arrived on one side has been sent on to the other
    delivery_.wait();
  }
}

void FaultRig::pass_period() {
  deliver();
  drives_->update(now_);
  deliver();
  now_ += robot_.cycle;
  master_.look_at_interface();  // as a watch beside the loop does
  drives_bus_.look_at_interface();
}

void FaultRig::run(Duration time) {
  for (const Instant end = now_ + time; now_ < end;) {
    cycle();
  }
}

bool FaultRig::run_until(const std::function<bool(FaultRig&)>& condition, Duration limit) {
  for (const Instant end = now_ + limit; now_ < end;) {
    cycle();
    if (condition(*this)) {
      return true;
    }
  }
  return false;
}

bool FaultRig::run_until(Mode mode, Duration limit) {
  return run_until([mode](FaultRig& rig) { return rig.status().mode == mode; }, limit);
}

bool FaultRig::drive_at_speed() {
  power_on();
  if (!run_until(Mode::kAwaitingConsent, 30s) || !consent_and_move()) {
    return false;
  }
  Duration fast{};
  return run_until(
      [&fast](FaultRig& rig) {
        fast = rig.rim_speed_mps() >= 0.9 * kSpeed_mps ? fast + rig.robot().cycle : Duration::zero();
        return fast >= 200ms;
      },
      20s);
}

bool FaultRig::consent_and_move() {
  loop_->command(OperatorCommand::kConsent);
  return run_until([](FaultRig& rig) { return rig.status().mode == Mode::kSearching && rig.rim_speed_mps() > 0.1; },
                   5s);
}

void FaultRig::tell(Wheel wheel, const hal::CanFrame& frame) {
  drivers::SimDrive::Outbox out;
  drive(wheel).on_frame(frame, out);
  (void)drives_bus_.send(out.span(), now_);
}

void FaultRig::tool(const std::vector<std::string>& words) {
  if (const Result<void> ran = run_tool(words); !ran && complaint_.empty()) {
    complaint_ = ran.error().message;
  }
}

bool FaultRig::at_rest() {
  for (int i = 0; i < kWheels; ++i) {
    if (drive(static_cast<Wheel>(i)).motion().velocity() != 0) {
      return false;
    }
  }
  return true;
}

double FaultRig::rim_speed_mps() {
  double fastest = 0.0;
  for (std::size_t i = 0; i < robot_.drives.size(); ++i) {
    const DriveParameters& parameters = robot_.drives[i];
    const double units = drive(static_cast<Wheel>(i)).motion().velocity();
    const double radps = units / (parameters.velocity_per_radps * parameters.gear_ratio);
    fastest = std::max(fastest, std::abs(radps) * robot_.base.wheel_radius_m);
  }
  return fastest;
}

}  // namespace ivo::firmware::bench
