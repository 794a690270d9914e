#include "firmware/tools/bench/loop/loop_rig.hpp"

#include "firmware/tools/planner_object.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr double kSide_m = 40.0;
constexpr double kPixel_m = 0.25;
constexpr double kSpacing_m = 3.5;
constexpr double kSpeed_mps = 0.5;

}  // namespace

LoopRig::LoopRig(int generations)
    : scene_(open_ground(kSide_m, kSide_m, kPixel_m, kSpacing_m)),
      ring_(std::make_unique<TraceRing>()),
      traced_bus_(bus_.port(0), tracer_),
      drives_(bus_.port(1), robot_, drivers::SimDrives::TimeFrom::kClock) {
  scene_.problem.colony.generations = generations;
  if (the_planner().prepare(scene_.problem)) {
    return;
  }
  LoopSetup setup{.robot = robot_, .start = {}, .searchers = {}, .object = {}};
  for (std::size_t m = 0; m < scene_.problem.agents.size(); ++m) {
    (void)setup.searchers.push_back({.kind = m == 0 ? AgentKind::kRobot : AgentKind::kPerson,
                                     .start = scene_.problem.agents[m].body.start,
                                     .speed_mps = kSpeed_mps});
  }
  const Point start = setup.searchers[0].start;
  setup.start = {start.x_m, start.y_m, 0.0};
  setup.stopwatch = &stopwatch_;
  setup.tracer = &tracer_;
  setup.real_time = true;
  setup.overruns_count_only = true;
  loop_ = std::make_unique<ControlLoop>(setup, the_planner(), traced_bus_);
  drives_.open();
  loop_->open(now_);
}

void LoopRig::trace(bool traced) noexcept { tracer_ = traced ? Tracer(stopwatch_, ring_.get()) : Tracer(); }

CycleCost LoopRig::cycle() {
  const PhaseTimes& times = loop_->times();
  std::array<Duration, kPhases> before{};
  for (std::size_t i = 0; i < kPhases; ++i) {
    before[i] = times.phases[i].total();
  }
  const std::int64_t units = loop_->planner_units();
  const Instant begin = stopwatch_.now();
  loop_->cycle({.now = now_});
  CycleCost cost{.whole_us = microseconds(stopwatch_.now() - begin)};
  for (std::size_t i = 0; i < kPhases; ++i) {
    cost.phases_us[i] = microseconds(times.phases[i].total() - before[i]);
  }
  cost.planner_units = static_cast<double>(loop_->planner_units() - units);
  drives_.update(now_);
  now_ += robot_.cycle;
  for (TraceEvent event; ring_->pop(event);) {  // the writer's part
  }
  return cost;
}

bool LoopRig::reach(Mode mode, int cycles) {
  for (; cycles > 0 && loop_->status().mode != mode; --cycles) {
    (void)cycle();
  }
  return loop_->status().mode == mode;
}

}  // namespace ivo::firmware::bench
