// `ivo run --trace FILE --log FILE --trace-marker`: the loop's ring, and whoever makes something of what is in it.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/mission/resumed_search.hpp"
#include "firmware/record/mcap_trace.hpp"
#include "firmware/record/trace_sink.hpp"
#include "firmware/record/traced_bus.hpp"
#include "firmware/record/tracer.hpp"
#include "firmware/tools/follower.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_world.hpp"
#include "firmware/tools/trace/belief_left.hpp"
#include "hal/linux/trace_marker.hpp"

namespace ivo::firmware {

class RunTrace {
 public:
  /// Holds the files that were asked for; start() begins them. What it is given outlives this; `planner` is prepared.
  [[nodiscard]] static Result<std::unique_ptr<RunTrace>> open(const RunOptions& options, RunWorld& world,
                                                              const MissionInputs& inputs,
                                                              const planner::Planner& planner);
  RunTrace(const RunTrace&) = delete;
  RunTrace& operator=(const RunTrace&) = delete;
  ~RunTrace() = default;

  /// Besides the files, before start().
  void add_sink(std::unique_ptr<TraceSink> sink) { sinks_.push_back(std::move(sink)); }
  /// Before the loop is made. Where time does not wait for it, a thread of its own writes from now on. `resumed`: the
  /// search that the loop takes up, where it does: what it has looked at is searched.
  void start(const ResumedSearch* resumed = nullptr);

  /// For the loop, by `stopwatch` of the world; null when nothing is wanted.
  [[nodiscard]] Tracer* tracer() noexcept { return tracer_.on() ? &tracer_ : nullptr; }
  /// What the loop is to send and receive by; `bus` itself when nothing is wanted.
  [[nodiscard]] hal::CanBus& bus(hal::CanBus& bus);

  /// Between cycles, where time waits for it; elsewhere this does nothing.
  void drain();
  /// Once the plan is there.
  void show_plan(const planner::Plan& plan);

  /// Once the loop has ended: every sink has taken all there is, and nobody writes to it any more.
  void finish();
  /// How one file ended: "4711 events in FILE", and what is missing in it.
  struct Ended {
    std::string summary;
    Result<void> outcome;
  };
  /// Finishes, and ends the files.
  [[nodiscard]] std::vector<Ended> close();
  [[nodiscard]] std::uint64_t lost() const noexcept { return ring_.lost(); }

 private:
  RunTrace(const RunOptions& options, RunWorld& world, const MissionInputs& inputs, const planner::Planner& planner);
  [[nodiscard]] Result<void> open_files();
  void take_all();
  void look(const TraceEvent& event);
  void look_where_it_was(const ResumedSearch& resumed);
  void show_belief();

  const RunOptions& options_;
  RunWorld& world_;
  const MissionInputs& inputs_;
  std::vector<double> sight_radii_m_;  // of the agents; people may draw while a thread of ours looks
  const planner::Planner& planner_;
  TraceRing ring_;
  std::optional<hal::TraceMarker> marker_;
  Tracer tracer_;
  std::optional<TracedBus> bus_;
  std::mutex writing_;  // the session's thread brings the plan
  std::vector<std::unique_ptr<TraceSink>> sinks_;
  McapTrace* log_ = nullptr;  // among them
  std::optional<BeliefLeft> belief_;
  bool searching_ = false;
  std::int64_t loop_ns_ = 0;
  std::int64_t next_look_ns_ = 0;
  std::int64_t next_belief_ns_ = 0;
  Follower writer_;  // last: it ends before what it writes to
};

}  // namespace ivo::firmware
