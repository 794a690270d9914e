// What a run keeps of its search in DIR/search.state, so that it survives the run's end at any moment; and the decision
// what to do with what an earlier run kept there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/loop/loop_status.hpp"
#include "firmware/record/state_writer.hpp"
#include "firmware/tools/event_log.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/resume/found_search.hpp"
#include "firmware/tools/resume/kept_search.hpp"
#include "firmware/tools/resume/logged_run.hpp"
#include "firmware/tools/run_options.hpp"

namespace ivo::firmware {

/// The robot of a mission at its start, those who search, and where: search_world().
struct SearchTeam {
  Pose start;
  Searchers searchers;
  std::string world;
};

/// All calls from the thread that observes the loop.
class SearchKeeper {
 public:
  /// Begins a search in options.out, or takes up the one that was cut off there where options.resume says so, and says
  /// on the terminal what was found. `log` is open and locked: it is begun anew or gone on with. Refuses, in one line,
  /// a folder that cannot be written, and to take up a search of files that have changed, of another version or of a
  /// damaged state, or on another bus; what is not taken up, and that somebody had set off in, is set aside, log and
  /// report with it, and that is said.
  [[nodiscard]] static Result<std::unique_ptr<SearchKeeper>> open(const RunOptions& options,
                                                                  const MissionInputs& inputs, const SearchTeam& team,
                                                                  EventLog& log);

  /// A search that was cut off is taken up: consent that was given beforehand does not count.
  [[nodiscard]] bool taken_up() const noexcept { return taken_up_; }
  /// It, with its plan; null when there is none, or it was cut off before it had one. Changes with observe().
  [[nodiscard]] const ResumedSearch* resumed() const noexcept { return plan_taken_over_ ? &kept_.search : nullptr; }

  /// Keeps the plan before anybody is asked to agree to it; one that was taken over only when it was made anew. Waits
  /// for the disk.
  [[nodiscard]] Result<void> keep_plan(const planner::Plan& plan, int generations, const LoopStatus& status,
                                       const EventLog& log);
  /// Keeps the search once a second while it goes on, and when it comes to a turn; waits for nothing. A search that is
  /// taken up stays as it was kept until somebody agrees to go on.
  void observe(const LoopStatus& status, const EventLog& log);
  /// Why the search is not kept at the moment; none while it is.
  [[nodiscard]] std::optional<Error> failure() { return writer_->failure(); }
  /// All is over and reported, and `log` closed. A search that came to its end, or that nobody agreed to, is left
  /// behind; one that was stopped, ended by a fault, or that nobody agreed to go on with can be taken up from where it
  /// stands. Waits for the disk.
  [[nodiscard]] Result<void> end(const LoopStatus& status, const EventLog& log);

 private:
  SearchKeeper() = default;
  [[nodiscard]] Result<StateFile> take_up(const std::string& out, const MissionInputs& inputs, const SearchTeam& team,
                                          const FoundSearch& found, const LoggedRun& logged, EventLog& log);
  [[nodiscard]] Result<StateFile> begin_anew(const std::string& out, const std::string& world,
                                             std::vector<KeptSource> sources, const FoundSearch& found,
                                             const LoggedRun& logged, EventLog& log);
  [[nodiscard]] std::string bytes(const EventLog& log, double at_s);
  void take_over(const LoopStatus& status);
  void nobody_has_begun();

  KeptSearch kept_;
  bool taken_up_ = false;
  bool plan_taken_over_ = false;
  std::uint32_t plan_kept_ = 0;  // its number
  bool plan_followed_ = false;   // it was, when it was kept last
  Instant kept_at_{};
  Mode mode_ = Mode::kPlanning;
  SearchState search_ = SearchState::kRunning;
  bool started_ = false;
  std::unique_ptr<StateWriter> writer_;
};

}  // namespace ivo::firmware
