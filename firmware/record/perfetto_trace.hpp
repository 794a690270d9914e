// `--trace`: the cycles of a run as tracks of Perfetto. Time is the stopwatch's.
#pragma once

#include <string>

#include "config/base/result.hpp"
#include "firmware/record/perfetto_file.hpp"
#include "firmware/record/trace_names.hpp"
#include "firmware/record/trace_sink.hpp"

namespace ivo::firmware {

/// Tracks: phases within their cycle, slices of the planner, frames in and out, the mode, what went wrong; counters of
/// cycle, wake-up latency, planner work and lost events.
class PerfettoTrace final : public TraceSink {
 public:
  struct Options {
    TraceNames names;
    /// The loop's time is the machine's: a frame is shown where it arrived, not where it was read.
    bool real_time = false;
    RecordFile::Earlier earlier = RecordFile::Earlier::kReplaced;
  };
  [[nodiscard]] static Result<PerfettoTrace> create(const std::string& path, Options options);

  void take(const TraceEvent& event) override;
  void write_out() override { file_.write_out(); }
  [[nodiscard]] Result<void> close(std::uint64_t lost) override;
  [[nodiscard]] std::string summary() const override;

 private:
  struct Tracks {
    PerfettoFile::Track cycle, planner, in, out, mode, trouble;
    PerfettoFile::Track cycle_ns, latency_ns, units, moves, lost;
  };
  PerfettoTrace(PerfettoFile file, Options options);
  void begin_cycle(const TraceEvent& event);
  void end_cycle(const TraceEvent& event);
  void frame(const TraceEvent& event);
  void enter_mode(const TraceEvent& event);

  PerfettoFile file_;
  Options options_;
  Tracks tracks_;
  bool cycle_open_ = false;
  bool mode_open_ = false;
  Instant last_{};
};

}  // namespace ivo::firmware
