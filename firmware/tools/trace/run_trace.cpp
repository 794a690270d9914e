#include "firmware/tools/trace/run_trace.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "firmware/loop/phase.hpp"
#include "firmware/record/perfetto_trace.hpp"
#include "firmware/safety/mode.hpp"
#include "firmware/tools/record_time.hpp"
#include "firmware/tools/trace/trace_words.hpp"

namespace ivo::firmware {
namespace {

constexpr std::int64_t kLookEveryNs = 200'000'000;
// A map of so many cells is written once a second; a larger one accordingly less often.
constexpr std::int64_t kBeliefCells = 20'000;
constexpr std::int64_t kSecondNs = 1'000'000'000;

std::vector<std::string_view> phase_names() {
  std::vector<std::string_view> names;
  for (std::size_t phase = 0; phase < kPhases; ++phase) {
    names.push_back(name_of(static_cast<Phase>(phase)));
  }
  return names;
}

}  // namespace

Result<std::unique_ptr<RunTrace>> RunTrace::open(const RunOptions& options, RunWorld& world,
                                                 const MissionInputs& inputs, const planner::Planner& planner) {
  std::unique_ptr<RunTrace> trace(new RunTrace(options, world, inputs, planner));
  if (const Result<void> opened = trace->open_files(); !opened) {
    return opened.error();
  }
  return trace;
}

RunTrace::RunTrace(const RunOptions& options, RunWorld& world, const MissionInputs& inputs,
                   const planner::Planner& planner)
    : options_(options), world_(world), inputs_(inputs), planner_(planner) {
  for (const AgentSpec& agent : inputs.file.mission.agents) {
    sight_radii_m_.push_back(agent.sight_radius_m);
  }
}

Result<void> RunTrace::open_files() {
  const TraceNames names = trace_words(inputs_.robot, inputs_.file.mission);
  if (options_.trace_marker) {
    Result<hal::TraceMarker> marker = hal::TraceMarker::open(phase_names());
    if (!marker) {
      return marker.error();
    }
    marker_.emplace(std::move(marker).value());
  }
  if (!options_.trace.empty()) {
    Result<PerfettoTrace> trace =
        PerfettoTrace::create(options_.trace, {.names = names,
                                               .real_time = !world_.own_time() && options_.speed == 1.0,
                                               .earlier = earlier_record(options_)});
    if (!trace) {
      return trace.error();
    }
    add_sink(std::make_unique<PerfettoTrace>(std::move(trace).value()));
  }
  if (!options_.log.empty()) {
    Result<McapTrace> log = McapTrace::create(
        options_.log, {.names = names, .epoch = record_epoch(options_, world_), .earlier = earlier_record(options_)});
    if (!log) {
      return log.error();
    }
    auto owned = std::make_unique<McapTrace>(std::move(log).value());
    log_ = owned.get();
    add_sink(std::move(owned));
    belief_.emplace(planner_);
  }
  return {};
}

void RunTrace::start(const ResumedSearch* resumed) {
  if (belief_ && resumed != nullptr && resumed->started) {
    look_where_it_was(*resumed);
  }
  tracer_ = Tracer(world_.stopwatch(), sinks_.empty() ? nullptr : &ring_, marker_ ? &*marker_ : nullptr);
  if (!world_.own_time() && !sinks_.empty()) {
    writer_.start("ivo-trace", record_every(options_), [this] { take_all(); });
  }
}

hal::CanBus& RunTrace::bus(hal::CanBus& bus) { return sinks_.empty() ? bus : bus_.emplace(bus, tracer_); }

void RunTrace::drain() {
  if (!writer_.running()) {
    take_all();
  }
}

void RunTrace::take_all() {
  const std::lock_guard<std::mutex> lock(writing_);
  for (TraceEvent event; ring_.pop(event);) {
    for (const std::unique_ptr<TraceSink>& sink : sinks_) {
      sink->take(event);
    }
    if (log_ != nullptr) {
      look(event);
    }
  }
  for (const std::unique_ptr<TraceSink>& sink : sinks_) {
    sink->write_out();
  }
}

// What the log shows of the belief, by where the agents are.
void RunTrace::look(const TraceEvent& event) {
  if (event.kind == TraceKind::kCycleBegan) {
    loop_ns_ = event.get<TracedCycle>().loop_ns;
    return;
  }
  if (event.kind == TraceKind::kCycleEnded && loop_ns_ >= next_look_ns_) {
    next_look_ns_ = loop_ns_ + kLookEveryNs;
    if (loop_ns_ >= next_belief_ns_) {
      next_belief_ns_ = loop_ns_ + kSecondNs * std::max<std::int64_t>(1, belief_->cells().count() / kBeliefCells);
      show_belief();
    }
    return;
  }
  // The poses of one cycle in so many are enough.
  if (event.kind == TraceKind::kPose && loop_ns_ >= next_look_ns_ && searching_) {
    const TracedPose pose = event.get<TracedPose>();
    belief_->look({pose.x_m, pose.y_m}, sight_radii_m_.at(event.id));
  }
  if (event.kind == TraceKind::kMode) {
    searching_ = searching_ || event.code == static_cast<std::uint8_t>(Mode::kSearching);
  }
}

void RunTrace::look_where_it_was(const ResumedSearch& resumed) {
  for (std::size_t i = 0; i < std::min(sight_radii_m_.size(), resumed.plan.paths.size()); ++i) {
    belief_->look_along(resumed.plan.paths[i].waypoints.span(), resumed.progress.tracks.at(i).moved_m,
                        sight_radii_m_[i]);
  }
}

void RunTrace::show_belief() {
  log_->add_belief(
      {.columns = belief_->cells().columns(), .cell_m = belief_->cells().cell_m(), .values = belief_->mass()});
}

void RunTrace::show_plan(const planner::Plan& plan) {
  const std::lock_guard<std::mutex> lock(writing_);
  if (log_ != nullptr) {
    for (std::size_t agent = 0; agent < plan.paths.size(); ++agent) {
      log_->add_plan(agent, plan.paths[agent].waypoints.span());
    }
  }
}

void RunTrace::finish() {
  writer_.stop();
  take_all();
}

std::vector<RunTrace::Ended> RunTrace::close() {
  finish();
  std::vector<Ended> ended;
  for (const std::unique_ptr<TraceSink>& sink : sinks_) {
    Result<void> outcome = sink->close(ring_.lost());
    if (std::string summary = sink->summary(); !summary.empty()) {
      ended.push_back({std::move(summary), std::move(outcome)});
    }
  }
  if (marker_ && marker_->lost() > 0) {
    ended.push_back({"lines in " + std::string(hal::TraceMarker::kFile),
                     Error{std::string(hal::TraceMarker::kFile) + ": " + std::to_string(marker_->lost()) +
                           " lines are missing; expected a kernel that takes them"}});
  }
  return ended;
}

}  // namespace ivo::firmware
