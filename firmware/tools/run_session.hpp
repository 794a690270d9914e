// One run, seen from outside the loop: shows, asks, records, and writes what is left of it.
#pragma once

#include <optional>
#include <string>

#include "config/rates.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/loop/scheduler.hpp"
#include "firmware/tools/event_log.hpp"
#include "firmware/tools/frame_record.hpp"
#include "firmware/tools/run_documents.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_terminal.hpp"
#include "firmware/tools/run_world.hpp"

namespace ivo::firmware {

class RunSession {
 public:
  /// `record` may be null. All that is referred to outlives this.
  RunSession(const RunOptions& options, const RunView& view, ControlLoop& loop, RunWorld& world, EventLog log,
             FrameRecord* record);

  /// The loop, in a thread of its own where time is real, until it has finished; throws nothing but what memory that is
  /// not there throws, and then only once the robot stands.
  void to_the_end();
  /// The exit status.
  int write_and_tell();

 private:
  bool one_cycle();
  void observe(int wait_ms);
  void show_plan_once(const LoopStatus& status);
  void write_picture(const planner::Plan& plan, const LoopStatus& status, const RunOutcome& outcome);
  bool seek_consent();
  bool seek_clearing(const LoopStatus& status);
  void write(const char* name, const std::string& contents);
  void note(const Error& error);
  [[nodiscard]] std::string path_of(const char* name) const { return options_.out + "/" + name; }

  const RunOptions& options_;
  const RunView& view_;
  ControlLoop& loop_;
  RunWorld& world_;
  EventLog log_;
  FrameRecord* record_;
  RunTerminal terminal_;
  ConsentQuestion question_;
  ConsentQuestion clear_question_;
  std::optional<Instant> clear_asked_at_;
  std::uint8_t turning_told_ = 0;  // node-id of the wheel of which was said that it did not stop
  bool consented_before_ = false;  // and a fault has ended that: --yes was for the first time
  Scheduler scheduler_{Instant{}, rates::kCycle};
  std::int64_t skipped_ = 0;
  bool plan_shown_ = false;
  bool answered_ = false;
  bool write_failed_ = false;
};

}  // namespace ivo::firmware
