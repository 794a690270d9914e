// One run, seen from outside the loop: shows, asks, records, and writes what is left of it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/loop/control_loop.hpp"
#include "firmware/tools/consent_state.hpp"
#include "firmware/tools/event_log.hpp"
#include "firmware/tools/frame_record.hpp"
#include "firmware/tools/loop_runner.hpp"
#include "firmware/tools/real_time_use.hpp"
#include "firmware/tools/resume/search_keeper.hpp"
#include "firmware/tools/run_console.hpp"
#include "firmware/tools/run_documents.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_terminal.hpp"
#include "firmware/tools/run_world.hpp"
#include "firmware/tools/trace/run_trace.hpp"

namespace ivo::firmware {

class RunSession {
 public:
  /// `record` and `console` may be null. All that is referred to outlives this.
  RunSession(const RunOptions& options, const RunView& view, ControlLoop& loop, RunWorld& world, RealTimeUse real_time,
             EventLog log, SearchKeeper& keeper, FrameRecord* record, RunTrace& trace, RunConsole* console);

  /// Until the loop has finished; throws nothing but what memory that is not there throws, and then only once the robot
  /// stands.
  void to_the_end();
  /// The loop has made its last cycle. Any thread.
  [[nodiscard]] bool loop_ended() const noexcept { return runner_.ended(); }
  /// Called with each new mode's name.
  void show_modes_by(std::function<void(std::string_view)> show) { show_mode_ = std::move(show); }
  /// The exit status.
  int write_and_tell();

 private:
  void observe(int wait_ms);
  /// A plan that somebody has set off on, and what it was worth.
  struct FollowedPlan {
    std::uint32_t number = 0;
    planner::Plan plan;
    ScoreDocument score;
    BoundsDocument bounds;
  };

  void note_followed(const LoopStatus& status);
  void show_plan_once(const LoopStatus& status);
  void keep(const LoopStatus& status);
  void write_picture(const planner::Plan& plan, const LoopStatus& status, const RunOutcome& outcome);
  bool seek_consent(const LoopStatus& status);
  bool seek_clearing(const LoopStatus& status);
  [[nodiscard]] bool takes_up_a_way() const;
  void show_at_console(const LoopStatus& status, console::Asks asks);
  [[nodiscard]] bool nobody_answers() const { return console_ == nullptr && !ConsentQuestion::possible(); }
  [[nodiscard]] RunConsole::Said answer_to(ConsentQuestion& question, console::Asks asks);
  void observe_console(const LoopStatus& status);
  [[nodiscard]] bool plan_is_made_anew() const;
  bool write(const char* name, const std::string& contents);
  bool write_to(const std::string& path, const std::string& contents);
  void note(const Error& error);
  [[nodiscard]] std::string path_of(const char* name) const { return options_.out + "/" + name; }

  const RunOptions& options_;
  const RunView* view_;
  ControlLoop& loop_;
  RunWorld& world_;
  RealTimeUse real_time_;
  LoopRunner runner_;
  EventLog log_;
  SearchKeeper& keeper_;
  FrameRecord* record_;
  RunTrace& trace_;
  RunConsole* console_;
  RunTerminal terminal_;
  ConsentQuestion question_;
  ConsentQuestion clear_question_;
  std::optional<Instant> clear_asked_at_;
  std::function<void(std::string_view)> show_mode_;
  std::optional<Mode> mode_shown_;
  std::uint8_t turning_told_ = 0;  // node-id of the wheel of which was said that it did not stop
  ConsentState consent_;
  console::Asks asks_{};          // what we are waiting for
  std::uint32_t plan_shown_ = 0;  // its number
  std::unique_ptr<FollowedPlan> followed_;
  bool plan_not_kept_ = false;  // when it was shown
  bool write_failed_ = false;   // anything, at any time
  bool keeping_failed_ = false;
  bool areas_not_kept_ = false;
};

}  // namespace ivo::firmware
