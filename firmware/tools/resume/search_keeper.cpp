#include "firmware/tools/resume/search_keeper.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "config/rates.hpp"
#include "firmware/tools/resume/replay.hpp"
#include "firmware/tools/resume/search_sources.hpp"
#include "firmware/tools/resume/search_world.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""s;

constexpr Duration kKeepEvery = 1s;
constexpr const char* kState = "/search.state";
constexpr const char* kPreviousState = "/search.previous.state";
constexpr const char* kLog = "/events.jsonl";
constexpr const char* kPreviousLog = "/events.previous.jsonl";
constexpr const char* kReport = "/report.json";
constexpr const char* kPreviousReport = "/report.previous.json";
constexpr const char* kOrAnew = "or a run without --resume, which begins anew and keeps the old one beside it";

std::int64_t unix_time_s() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::vector<std::string> names_of(const Mission& mission) {
  std::vector<std::string> names;
  for (const AgentSpec& agent : mission.agents) {
    names.push_back(agent.name);
  }
  return names;
}

// From the last that was kept to the end of the run, until the drives miss it, and their own ramp.
double rolled_on_m(const MissionInputs& inputs) {
  const MotionLimits& limits = inputs.robot.limits;
  const double speed_mps = std::min(limits.max_speed_mps, inputs.file.mission.agents.front().speed_mps);
  return speed_mps * seconds(kKeepEvery + rates::kMasterHeartbeatTimeout) +
         speed_mps * speed_mps / (2 * limits.quick_stop_mps2);
}

// Why the search that was found is not this mission's or cannot be taken up; empty when it can.
std::string refusal(const FoundSearch& found, const std::vector<KeptSource>& sources, const SearchTeam& team,
                    const std::string& out) {
  if (!found.fault.empty()) {
    return found.fault + ", " + kOrAnew;
  }
  if (const std::string other = other_world(found.kept->world, team.world); !other.empty()) {
    return out + ": " + other + ", " + kOrAnew;
  }
  if (const std::string changed = changed_source(found.kept->sources, sources); !changed.empty()) {
    return changed + ": has changed since the search in " + out + " began; expected it as it was, " + kOrAnew;
  }
  const std::size_t agents = team.searchers.size();
  const std::size_t planned = found.kept->search.plan.paths.size();
  return found.kept->planned && planned != agents ? out + kState + ": holds paths of " + std::to_string(planned) +
                                                        " agents; expected " + std::to_string(agents) + ", " + kOrAnew
                                                  : std::string();
}

void say_taken_up(const KeptSearch& kept, const MissionInputs& inputs) {
  const std::string age = age_text(unix_time_s() - kept.unix_time_s);
  if (!kept.planned) {
    say("resumed", "a search that was begun " + age + " and cut off while it was being planned: it is planned anew");
  } else if (!kept.search.started) {
    say("resumed",
        "a search that was planned " + age + " and cut off before anybody had set off: the plans are the same");
  } else {
    say("resumed",
        "a search that was last heard of " + age + ", " +
            format("%.1f s under way: plans, tracks and log are as they were", seconds(kept.search.progress.elapsed)));
    say("check", inputs.file.mission.agents.front().name + " is taken to stand at " +
                     place_text(kept.search.robot.point()) +
                     format("; it may have rolled on by up to %.2f m, or been moved: see to it before you agree",
                            rolled_on_m(inputs)));
  }
}

void say_losses(const FoundSearch& found, const LoggedRun& log) {
  if (found.state.other_torn) {
    say("note", "the newest state was not whole, as when a run ends while it writes it; the one before it is used");
  }
  if (log.whole_bytes < found.kept->log_bytes) {
    say("note", format("events.jsonl is %llu bytes shorter than it was: what they told is lost",
                       static_cast<unsigned long long>(found.kept->log_bytes - log.whole_bytes)));
  }
  if (log.unreadable > 0) {
    say("note",
        counted(log.unreadable, "line") + " of events.jsonl cannot be read; the tracks are without what they told");
  }
}

// All but the log. The state goes first: without it nothing is taken up, and a log that somebody had set off in is kept
// all the same.
Result<void> set_aside(const std::string& out, const FoundSearch& found) {
  if (found.there) {
    if (const Result<void> aside = StateFile::set_aside(out + kState, out + kPreviousState); !aside) {
      return aside.error();
    }
  }
  const std::string previous = out + kPreviousReport;
  std::error_code failed;
  std::filesystem::remove(previous, failed);  // of a search before that
  if (std::filesystem::exists(out + kReport, failed)) {
    std::filesystem::rename(out + kReport, previous, failed);
  }
  return failed ? Result<void>(Error{previous + ": cannot be written: " + failed.message()}) : Result<void>();
}

}  // namespace

Result<std::unique_ptr<SearchKeeper>> SearchKeeper::open(const RunOptions& options, const MissionInputs& inputs,
                                                         const SearchTeam& team, EventLog& log) {
  Result<std::vector<KeptSource>> sources = search_sources(inputs);
  if (!sources) {
    return sources.error();
  }
  Result<FoundSearch> found = look_for_search(options.out + kState);
  if (!found) {
    return found.error();
  }
  const bool take_up = options.resume && found.value().unfinished();
  if (take_up) {
    if (const std::string why = refusal(found.value(), sources.value(), team, options.out); !why.empty()) {
      return Error{why};
    }
  }
  const Result<LoggedRun> logged = read_logged_run(options.out + kLog, names_of(inputs.file.mission));
  if (!logged) {
    return logged.error();
  }
  if (options.resume && !take_up) {
    say("resume", "no search was cut off in " + options.out + ": a new one begins");
  }
  std::unique_ptr<SearchKeeper> keeper(new SearchKeeper());
  Result<StateFile> file = take_up ? keeper->take_up(options.out, inputs, team, found.value(), logged.value(), log)
                                   : keeper->begin_anew(options.out, team.world, std::move(sources).value(),
                                                        found.value(), logged.value(), log);
  if (!file) {
    return file.error();
  }
  keeper->writer_ = std::make_unique<StateWriter>(std::move(file).value(), log.descriptor());
  return keeper;
}

Result<StateFile> SearchKeeper::take_up(const std::string& out, const MissionInputs& inputs, const SearchTeam& team,
                                        const FoundSearch& found, const LoggedRun& logged, EventLog& log) {
  taken_up_ = true;
  kept_ = *found.kept;
  plan_taken_over_ = kept_.planned;
  if (kept_.planned) {
    replay(logged, team.searchers, team.start, kept_);
  }
  if (const Result<void> gone_on = log.go_on(logged, seconds(kept_.search.progress.elapsed)); !gone_on) {
    return gone_on.error();
  }
  say_taken_up(kept_, inputs);
  say_losses(found, logged);
  return StateFile(out + kState, KeptSearch::kVersion, found.state);
}

Result<StateFile> SearchKeeper::begin_anew(const std::string& out, const std::string& world,
                                           std::vector<KeptSource> sources, const FoundSearch& found,
                                           const LoggedRun& logged, EventLog& log) {
  // Somebody had set off, or nobody knows.
  const bool worth_keeping = !logged.steps.empty() || (found.there && (!found.fault.empty() || found.kept->consented));
  if (worth_keeping) {
    const std::string what = !found.unfinished()   ? out + ": an earlier search is here"
                             : found.fault.empty() ? out + ": a search was cut off here, and --resume would take it up"
                                                   : found.fault;
    say("note", what + "; it is kept as " + (kPreviousState + 1) + ".* and " + (kPreviousLog + 1));
    if (const Result<void> aside = set_aside(out, found); !aside) {
      return aside.error();
    }
  }
  if (const Result<void> begun = log.start_anew(worth_keeping ? out + kPreviousLog : ""); !begun) {
    return begun.error();
  }
  kept_.world = world;
  kept_.sources = std::move(sources);
  kept_.unix_time_s = unix_time_s();
  return StateFile::create(out + kState, KeptSearch::kVersion, worth_keeping ? FoundState{} : found.state,
                           to_bytes(kept_));
}

Result<void> SearchKeeper::keep_plan(const planner::Plan& plan, int generations, const LoopStatus& status,
                                     const EventLog& log) {
  plan_kept_ = status.plan_number;
  plan_followed_ = false;
  if (plan_taken_over_ && status.plan_number == 1) {
    return {};
  }
  kept_.planned = true;
  kept_.search.plan = plan;
  kept_.search.generations = generations;
  if (!status.search_started) {
    return writer_->keep_and_wait(bytes(log, 0.0));
  }
  take_over(status);  // under way: where everybody is belongs to the plan that begins there
  nobody_has_begun();
  return writer_->keep_and_wait(bytes(log, log.time_s(status.at)));
}

// All of the plan is left, and what everybody has gone was before it.
void SearchKeeper::nobody_has_begun() {
  ResumedSearch& search = kept_.search;
  search.distance_left_m = search.plan.paths[0].length_m;
  for (AgentTrack& track : search.progress.tracks) {
    track.before_m = track.moved_m;
  }
}

void SearchKeeper::observe(const LoopStatus& status, const EventLog& log) {
  if (!kept_.planned || !status.consented) {
    return;
  }
  const bool turn = status.mode != mode_ || status.search != search_ || status.search_started != started_;
  if (!turn && status.at - kept_at_ < kKeepEvery) {
    return;
  }
  mode_ = status.mode;
  search_ = status.search;
  started_ = status.search_started;
  kept_at_ = status.at;
  kept_.consented = true;
  take_over(status);
  writer_->keep(bytes(log, log.time_s(status.at)));
}

Result<void> SearchKeeper::end(const LoopStatus& status, const EventLog& log) {
  const bool searching = status.search == SearchState::kRunning;
  if (taken_up_ && searching && !status.consented) {
    return {};
  }
  if (kept_.planned && status.consented) {
    kept_.consented = true;
    take_over(status);
  }
  const bool nobody_set_off = status.stop_cause == StopCause::kNoConsent && !status.search_started;
  kept_.ended = !searching || nobody_set_off;
  return writer_->keep_and_wait(bytes(log, log.time_s(status.at)));
}

std::string SearchKeeper::bytes(const EventLog& log, double at_s) {
  kept_.unix_time_s = unix_time_s();
  kept_.at_s = at_s;
  kept_.log_bytes = log.bytes();
  return to_bytes(kept_);
}

// How far everybody has come along a plan is said of one plan at a time, and not always of the one that is kept.
void SearchKeeper::take_over(const LoopStatus& status) {
  ResumedSearch& search = kept_.search;
  const std::array<AgentTrack, limits::kAgents> tracks = search.progress.tracks;
  search.started = status.search_started;
  search.progress = {status.tracks, status.search_time, status.search, status.finder};
  search.robot = status.robot;
  if (status.way_of_plan == plan_kept_ || plan_kept_ == 0) {
    search.distance_left_m = status.distance_left_m;
    plan_followed_ = status.way_followed;
  } else if (!plan_followed_) {
    nobody_has_begun();
  } else {
    for (std::size_t m = 0; m < tracks.size(); ++m) {
      search.progress.tracks[m].before_m = tracks[m].before_m;
    }
  }
}

}  // namespace ivo::firmware
