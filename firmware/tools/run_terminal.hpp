// The terminal of a run: what is going on, both plans, the question, the result. Outside the loop.
#pragma once

#include <cstdint>
#include <string>

#include "firmware/tools/run_documents.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {

class RunTerminal {
 public:
  explicit RunTerminal(const RunView& run);
  /// Another planner's plans from here on.
  void look_at(const RunView& run) noexcept { run_ = &run; }

  void show_mission(const std::string& bus) const;
  /// Drawn over itself on a terminal; elsewhere a line a tenth of the way.
  void show_planning(const planner::Progress& progress);
  void show_plan(const planner::Plan& plan);
  void show_starting(const LoopStatus& status);
  void show_search(const LoopStatus& status);
  void show_fault(const LoopStatus& status) const;
  void show_result(const RunOutcome& outcome, const LoopStatus& status, const planner::Plan* plan,
                   std::uint64_t lapses);
  void show_file(const std::string& path) const;
  /// Ends the line that is drawn over itself.
  void end_line() { line_.end(); }

 private:
  const RunView* run_;
  LiveLine line_;
  double horizon_s_ = 0.0;
  bool stop_held_ = false;  // and said
};

enum class Answer : std::uint8_t { kNone, kYes, kNo };

/// Asks one question once; the answer comes from poll().
class ConsentQuestion {
 public:
  /// Whether there is a terminal on which somebody sees what is asked and can answer.
  [[nodiscard]] static bool possible();
  /// Where it is not possible nothing is shown, and nobody answers.
  void ask(const char* label, const char* question);
  /// Waits up to `wait_ms` for a line; a signal ends the wait.
  [[nodiscard]] Answer poll(int wait_ms);
  [[nodiscard]] bool asked() const noexcept { return asked_; }
  /// Ends the question's line when nobody answered it.
  void close();

 private:
  bool asked_ = false;
  bool open_ = false;
};

}  // namespace ivo::firmware
