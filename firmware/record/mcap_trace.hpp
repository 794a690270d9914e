// `--log`: where everybody is and goes, what was told to the wheels, what was planned and what it cost, as channels of
// an MCAP file. Time is the loop's.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "firmware/record/json_text.hpp"
#include "firmware/record/mcap_file.hpp"
#include "firmware/record/trace_names.hpp"
#include "firmware/record/trace_sink.hpp"

namespace ivo::firmware {

/// Channels: /NAME/pose and /plan/NAME of each agent, /tf, /belief, /command, /wheels, /timing, /events. Timing of
/// every cycle; poses, commands and wheels every 20 ms.
class McapTrace final : public TraceSink {
 public:
  struct Options {
    TraceNames names;
    Duration epoch{};  ///< what a reader's clock says at Instant{}; zero for simulated time
    RecordFile::Earlier earlier = RecordFile::Earlier::kReplaced;
  };
  /// A map of numbers: rows from the south, columns from the west.
  struct Field {
    int columns = 0;
    double cell_m = 0.0;
    std::span<const float> values;
  };
  [[nodiscard]] static Result<McapTrace> create(const std::string& path, Options options);

  // At the time of the newest cycle.
  void add_plan(std::size_t agent, std::span<const Point> waypoints);
  void add_belief(const Field& mass);

  void take(const TraceEvent& event) override;
  void write_out() override { file_.write_out(); }
  [[nodiscard]] Result<void> close(std::uint64_t lost) override { return file_.close(lost); }
  [[nodiscard]] std::string summary() const override;

 private:
  McapTrace(McapFile file, Options options);
  [[nodiscard]] std::string agent(std::size_t number) const { return TraceNames::of(options_.names.agents, number); }
  void begin_cycle(const TracedCycle& cycle);
  void end_cycle(const TraceEvent& event);
  void add_pose(std::size_t number, const TracedPose& pose);
  void add_command(const TracedTwist& twist);
  void add_wheels(const TracedWheels& angles);
  void say(int level, const std::string& message);

  McapFile file_;
  Options options_;
  std::vector<McapFile::Channel> poses_;  // by agent
  std::vector<McapFile::Channel> plans_;
  McapFile::Channel frames_, belief_, command_, wheels_, timing_, events_;
  Duration now_{};   // of the cycle under way
  Duration next_{};  // when what is not for every cycle is due
  bool due_ = false;
  TracedCycle cycle_;
  TracedWheels told_;
  JsonText phases_;
};

}  // namespace ivo::firmware
