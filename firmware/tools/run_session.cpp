#include "firmware/tools/run_session.hpp"

#include <thread>
#include <utility>

#include "firmware/files/text_file.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/run_stats.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

constexpr int kAnswerMs = 50;
constexpr Duration kClearingTakes =
    std::chrono::seconds(10);  // a quick stop's time and a start-up's; then we ask again

}  // namespace

RunSession::RunSession(const RunOptions& options, const RunView& view, ControlLoop& loop, RunWorld& world,
                       RealTimeUse real_time, EventLog log, SearchKeeper& keeper, FrameRecord* record, RunTrace& trace,
                       RunConsole* console)
    : options_(options),
      view_(&view),
      loop_(loop),
      world_(world),
      real_time_(std::move(real_time)),
      runner_(loop, world, view.inputs.robot.cycle, real_time_.place),
      log_(std::move(log)),
      keeper_(keeper),
      record_(record),
      trace_(trace),
      console_(console),
      terminal_(view),
      consent_(options.yes && !keeper.taken_up()) {}

void RunSession::to_the_end() {
  terminal_.show_mission(world_.description());
  if (!real_time_.text.empty()) {
    say("loop", real_time_.text);
  }
  runner_.run([this](int wait_ms) { observe(wait_ms); });
}

int RunSession::write_and_tell() {
  const LoopStatus& status = loop_.status();
  const RunOutcome outcome = outcome_of(*view_, status, world_.stalled());
  note_followed(status);
  const planner::Plan* plan = followed_ ? &followed_->plan : status.plan_ready ? &loop_.plan() : nullptr;
  if (status.plan_ready) {
    show_plan_once(status);
  }
  question_.close();
  terminal_.show_result(outcome, status, plan, world_.lapses());
  ReportDocument document = report_document(*view_, plan, status, outcome);
  if (followed_) {
    document.score = followed_->score;
    document.bounds = followed_->bounds;
  }
  const std::string report = report_json(document);
  const bool reported = write("report.json", report);
  if (console_ != nullptr) {
    console_->dialogue().show_report(report);
  }
  if (plan != nullptr) {
    write_picture(*plan, status, outcome);
  }
  const Result<void> recorded = log_.close();
  recorded ? terminal_.show_file(path_of("events.jsonl")) : note(recorded.error());
  if (!options_.stats.empty()) {
    (void)write_to(options_.stats,
                   stats_json({status, loop_.times(), runner_.page_faults(), "CLOCK_MONOTONIC of this host"}));
  }
  if (record_ != nullptr) {
    const Result<void> closed = record_->close();
    say("recorded", record_->summary());
    if (!closed) {
      note(closed.error());
    }
  }
  for (const RunTrace::Ended& ended : trace_.close()) {
    say("traced", ended.summary);
    if (!ended.outcome) {
      note(ended.outcome.error());
    }
  }
  if (console_ != nullptr) {
    say("console", console_->close());
  }
  // Last: what is not reported has not ended.
  if (reported) {
    if (const Result<void> ended = keeper_.end(status, log_); !ended) {
      note(ended.error());
    }
  }
  if (write_failed_) {
    return exit_status::kFaultOrStop;
  }
  switch (outcome.end) {
    case RunEnd::kFound:
    case RunEnd::kPathsEnded:
      return exit_status::kEnded;
    case RunEnd::kNoConsent:
      return exit_status::kNoConsent;
    case RunEnd::kStopped:
    case RunEnd::kFault:
      break;
  }
  return exit_status::kFaultOrStop;
}

// `wait_ms`: how long to sleep while time goes on without us.
void RunSession::observe(int wait_ms) {
  // First: the log then tells of all that the status does, which is kept with it.
  const LoopStatus& status = loop_.status();
  log_.drain(loop_.events());
  if (record_ != nullptr) {
    record_->drain();
  }
  trace_.drain();
  keep(status);
  bool waited = false;
  if (mode_shown_ != status.mode && show_mode_) {
    show_mode_(name_of(status.mode));
  }
  mode_shown_ = status.mode;
  asks_ = console::Asks::kNothing;
  observe_console(status);
  note_followed(status);
  if (consent_.withdrawn_by(status)) {
    question_.close();
    if (console_ != nullptr) {  // an answer that lies there was to what is not asked any more
      show_at_console(status, console::Asks::kNothing);
    }
  }
  switch (status.mode) {
    case Mode::kPlanning:
      terminal_.show_planning(status.planning);
      break;
    case Mode::kStarting:
      if (status.plan_ready) {
        show_plan_once(status);
      }
      terminal_.show_starting(status);
      break;
    case Mode::kAwaitingConsent:
      if (plan_is_made_anew() || !status.plan_ready) {
        break;
      }
      show_plan_once(status);
      waited = seek_consent(status);
      break;
    case Mode::kSearching:
    case Mode::kPausing:
    case Mode::kStopping:
      if (status.search_started) {
        terminal_.show_search(status);
      }
      break;
    case Mode::kFault:
      waited = seek_clearing(status);
      break;
    case Mode::kDone:
      break;
  }
  if (console_ != nullptr) {
    show_at_console(status, asks_);
  }
  if (wait_ms > 0 && !waited) {
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
  }
}

// The plan of the report: a newer one may be made, or wait for consent, when the search ends.
void RunSession::note_followed(const LoopStatus& status) {
  const bool follows = status.way_followed && status.plan_ready && status.way_of_plan == status.plan_number;
  if (!follows || !status.search_started || (followed_ && followed_->number == status.plan_number)) {
    return;
  }
  const planner::Plan& plan = loop_.plan();
  followed_ = std::make_unique<FollowedPlan>(
      FollowedPlan{status.plan_number, plan, score_document(*view_, plan.score), bounds_of(*view_, plan.score)});
}

void RunSession::show_plan_once(const LoopStatus& status) {
  if (plan_shown_ == status.plan_number) {
    return;
  }
  plan_shown_ = status.plan_number;
  const planner::Plan& plan = loop_.plan();
  const ResumedSearch* const resumed = keeper_.resumed();
  const bool taken_over = resumed != nullptr && status.plan_number == 1;
  const int generations = taken_over ? resumed->generations : status.planning.generation;
  trace_.show_plan(plan);
  terminal_.show_plan(plan);
  const bool failed_before = std::exchange(write_failed_, false);
  (void)write("plan.json", plan_json(plan_document(*view_, plan, {generations})));
  write_picture(plan, status, {RunEnd::kNoConsent, "the plans, before anybody consented"});
  if (const Result<void> kept = keeper_.keep_plan(plan, generations, status, log_); !kept) {
    keeping_failed_ = true;
    note(kept.error());
  }
  plan_not_kept_ = write_failed_;
  write_failed_ = write_failed_ || failed_before;
  if (plan_not_kept_) {  // nobody agrees to what cannot be kept
    (void)loop_.command(OperatorCommand::kPlanNotKept);
  }
}

void RunSession::keep(const LoopStatus& status) {
  keeper_.observe(status, log_);
  const std::optional<Error> failure = keeper_.failure();
  if (failure && !keeping_failed_) {
    note({failure->message + "; a run that is cut off now loses what it does from here on"});
  }
  keeping_failed_ = failure.has_value();
}

void RunSession::write_picture(const planner::Plan& plan, const LoopStatus& status, const RunOutcome& outcome) {
  const Result<std::string> picture = picture_png(picture_of(*view_, plan, status, outcome, log_.tracks()));
  if (picture) {
    (void)write("search.png", picture.value());
  } else {
    note(picture.error());
  }
}

// True when it waited for an answer.
bool RunSession::seek_consent(const LoopStatus& status) {
  if (consent_.answered()) {
    return false;
  }
  if (plan_not_kept_) {  // nobody agrees to what cannot be kept
    consent_.answer(loop_.command(OperatorCommand::kPlanNotKept));
    return false;
  }
  const bool into_no_go = console_ != nullptr && console_->dialogue().may_not_set_off();
  if (consent_.beforehand() && !into_no_go) {
    consent_.answer(loop_.command(OperatorCommand::kConsent));
    return false;
  }
  if (nobody_answers()) {
    consent_.answer(loop_.command(OperatorCommand::kNoConsent));
    return false;
  }
  if (consent_.ask()) {
    const bool under_way = consent_.after_fault() || takes_up_a_way();
    question_.ask("consent", under_way ? "Go on with the search? The robot will move; Ctrl-C stops it. [y/N] "
                                       : "Start the search? The robot will move; Ctrl-C stops it. [y/N] ");
    if (!ConsentQuestion::possible()) {
      say("consent", "is waited for at " + options_.console);
    }
  }
  const RunConsole::Said said = answer_to(question_, console::Asks::kConsent);
  if (said.answer == Answer::kYes && into_no_go) {
    say("consent",
        "the plan leads into a no-go area that was drawn later; expected another plan first: ivo console replan");
    consent_.ask_again();
  } else if (said.answer == Answer::kYes) {
    OperatorCommand consent(OperatorCommand::kConsent);
    consent.watched = said.watched;
    consent.pauses = status.pauses;
    consent.times_ready = status.times_ready;
    const bool told = loop_.command(consent);
    consent_.answer(told);
    if (!told && console_ != nullptr) {  // is asked anew
      show_at_console(status, console::Asks::kNothing);
    }
  } else if (said.answer == Answer::kNo) {
    consent_.answer(loop_.command(OperatorCommand::kNoConsent));
  }
  return true;
}

// True when it waited for an answer.
bool RunSession::seek_clearing(const LoopStatus& status) {
  const bool being_cleared = clear_asked_at_ && status.at - *clear_asked_at_ < kClearingTakes;
  if (nobody_answers() || status.finished || being_cleared) {
    return false;
  }
  const std::uint8_t turning = status.drive_fault.turning_node_id;
  const bool news = std::exchange(turning_told_, turning) != turning && turning != 0;
  if (!clear_question_.asked() || news) {
    if (console_ != nullptr) {  // an answer to what was known before is none to this
      show_at_console(status, console::Asks::kNothing);
    }
    question_.close();
    clear_question_.close();
    terminal_.end_line();
    terminal_.show_fault(status);
    clear_question_.ask("fault", "Start the drives up again? Nothing moves before you consent anew. [y/N] ");
  }
  const Answer answer = answer_to(clear_question_, console::Asks::kClearing).answer;
  if (answer == Answer::kYes) {
    (void)loop_.command(OperatorCommand::kClearFault);
    clear_asked_at_ = status.at;
    clear_question_ = {};
    consent_.fault_cleared();
  } else if (answer == Answer::kNo) {
    loop_.request_stop();
  }
  return true;
}

bool RunSession::takes_up_a_way() const {
  const ResumedSearch* const resumed = keeper_.resumed();
  return resumed != nullptr && resumed->started;
}

void RunSession::show_at_console(const LoopStatus& status, console::Asks asks) {
  console_->show(status, asks, takes_up_a_way());
}

// Of the terminal or the console: who is first.
RunConsole::Said RunSession::answer_to(ConsentQuestion& question, console::Asks asks) {
  asks_ = asks;
  const Answer typed = question.poll(kAnswerMs);
  if (typed != Answer::kNone || console_ == nullptr) {
    return {typed};
  }
  const RunConsole::Said said = console_->answer_to(asks);
  if (said.answer != Answer::kNone) {
    question.close();
    terminal_.end_line();
    say(asks == console::Asks::kConsent ? "consent" : "fault",
        said.answer == Answer::kYes ? "the console says yes" : "the console says no");
  }
  return said;
}

// Before anything is asked: who wants another plan has not agreed to this one.
void RunSession::observe_console(const LoopStatus& status) {
  if (console_ == nullptr) {
    return;
  }
  console_->dialogue().observe(status);
  const std::optional<Error>& failure = console_->dialogue().failure();
  if (failure && !areas_not_kept_) {
    note({failure->message + "; a run that is cut off now loses the areas that are drawn"});
  }
  areas_not_kept_ = failure.has_value();
  const RunView& view = console_->dialogue().view();
  if (&view != view_) {
    view_ = &view;
    terminal_.look_at(view);
  }
  if (plan_is_made_anew()) {
    question_.close();
  }
}

bool RunSession::plan_is_made_anew() const { return console_ != nullptr && console_->dialogue().preparing(); }

bool RunSession::write(const char* name, const std::string& contents) { return write_to(path_of(name), contents); }

bool RunSession::write_to(const std::string& path, const std::string& contents) {
  const Result<void> written = write_file(path, contents);
  written ? terminal_.show_file(path) : note(written.error());
  return written.ok();
}

void RunSession::note(const Error& error) {
  write_failed_ = true;
  terminal_.end_line();
  complain(error);
}

}  // namespace ivo::firmware
