#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "config/rates.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/loop_runner.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/profile/event_cost.hpp"
#include "firmware/tools/profile/histogram_text.hpp"
#include "firmware/tools/profile/profile_options.hpp"
#include "firmware/tools/profile/profile_text.hpp"
#include "firmware/tools/run_documents.hpp"
#include "firmware/tools/run_setup.hpp"
#include "firmware/tools/run_world.hpp"
#include "firmware/tools/stop_signal.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/trace/run_trace.hpp"

namespace ivo::firmware {
namespace {

/// Who watches a run that is only measured: agrees at once, and writes down nothing.
class ProfileSession {
 public:
  ProfileSession(const ProfileOptions& options, ControlLoop& loop, RunTrace& trace)
      : options_(options), loop_(loop), trace_(trace) {}

  void observe() {
    trace_.drain();
    for (Event event; loop_.events().pop(event);) {
    }
    const LoopStatus& status = loop_.status();
    if (line_.live() && !status.plan_ready && line_.due(status.planning.generation, status.planning.generations)) {
      line_.draw("planning", bar(status.planning.generation, status.planning.generations));
    }
    if (status.plan_ready && !plan_shown_) {
      plan_shown_ = true;
      line_.end();
      trace_.show_plan(loop_.plan());
      if (options_.planning_only) {
        loop_.request_stop();
      }
    }
    if (status.mode == Mode::kAwaitingConsent && !agreed_) {
      agreed_ = loop_.command(OperatorCommand::kConsent);
    }
    if (stop_asked()) {
      loop_.request_stop();
    }
  }

 private:
  const ProfileOptions& options_;
  ControlLoop& loop_;
  RunTrace& trace_;
  LiveLine line_;
  bool plan_shown_ = false;
  bool agreed_ = false;
};

std::uint64_t times_preempted() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::uint64_t>(usage.ru_nivcsw) : 0;
}

void say_measured(const CycleProfile& profile, Duration period, const std::string& how, std::uint64_t preempted) {
  const std::uint64_t planning = profile.planning.cycle.count();
  say("measured", grouped(planning + profile.driving.cycle.count()) + " cycles of " +
                      std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(period).count()) + " us, " +
                      grouped(planning) + " of them planning, by CLOCK_MONOTONIC");
  say("ended", how);
  if (preempted > 0) {
    say("host",
        "took the processor away " + grouped(preempted) + " times: what lies far beyond the median is its doing");
  }
}

int tell(const ProfileView& view, RunTrace& trace) {
  int status = exit_status::kEnded;
  (void)std::fputs(profile_text(view).c_str(), stdout);
  for (const RunTrace::Ended& ended : trace.close()) {
    say("traced", ended.summary);
    if (!ended.outcome) {
      complain(ended.outcome.error());
      status = exit_status::kFaultOrStop;
    }
  }
  return status;
}

}  // namespace

int profile(const ProfileOptions& options) {
  Result<MissionInputs> read = read_inputs(options.run.mission);
  if (!read) {
    return refuse(read.error());
  }
  const MissionInputs inputs = std::move(read).value();
  const Result<std::unique_ptr<RunWorld>> world = RunWorld::open(options.run, inputs.robot);
  if (!world) {
    return refuse(world.error());
  }
  planner::Planner& planner = the_planner();
  if (const Result<void> prepared = prepare(planner, inputs); !prepared) {
    return refuse(prepared.error());
  }
  const Result<std::unique_ptr<RunTrace>> trace = RunTrace::open(options.run, *world.value(), inputs, planner);
  if (!trace) {
    return refuse(trace.error());
  }
  auto sink = std::make_unique<CycleProfile>();
  const CycleProfile& figures = *sink;
  trace.value()->add_sink(std::move(sink));
  trace.value()->start();

  const SearchObject object = object_of(inputs.file.mission, planner);
  LoopSetup setup = loop_setup(inputs, object, *world.value());
  setup.tracer = trace.value()->tracer();
  const auto loop = std::make_unique<ControlLoop>(setup, planner, trace.value()->bus(world.value()->bus()));
  stop_on_all_signals();
  say("mission", inputs.file.mission.name + ": " + world.value()->description());
  say("time", "simulated: " + grouped(rates::kPlannerUnitsPerCycle) +
                  " units of planner work a cycle; on a robot as many as the cycle has time for");
  ProfileSession session(options, *loop, *trace.value());
  LoopRunner runner(*loop, *world.value(), inputs.robot.cycle, std::nullopt);
  const std::uint64_t preempted = times_preempted();
  runner.run([&](int wait_ms) {
    session.observe();
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
  });
  trace.value()->finish();

  const RunOutcome outcome = outcome_of({{inputs, planner}, object}, loop->status(), world.value()->stalled());
  const bool asked = options.planning_only && outcome.end == RunEnd::kStopped;
  say_measured(figures, inputs.robot.cycle, asked ? "with the plan, as asked" : outcome.reason,
               times_preempted() - preempted);
  const int told = tell({.profile = figures,
                         .period = inputs.robot.cycle,
                         .event_cost_ns = measured_event_cost_ns(world.value()->stopwatch()),
                         .events_lost = trace.value()->lost()},
                        *trace.value());
  const bool ended = asked || outcome.end == RunEnd::kFound || outcome.end == RunEnd::kPathsEnded;
  return ended ? told : exit_status::kFaultOrStop;
}

}  // namespace ivo::firmware
