#include "firmware/tools/run_session.hpp"

#include <atomic>
#include <thread>
#include <utility>

#include "firmware/files/text_file.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

constexpr int kObserveEveryMs = 50;
constexpr int kObserveEveryCycles = 25;
constexpr Duration kClearingTakes =
    std::chrono::seconds(10);  // a quick stop's time and a start-up's; then we ask again

}  // namespace

RunSession::RunSession(const RunOptions& options, const RunView& view, ControlLoop& loop, RunWorld& world, EventLog log,
                       FrameRecord* record)
    : options_(options),
      view_(view),
      loop_(loop),
      world_(world),
      log_(std::move(log)),
      record_(record),
      terminal_(view) {}

void RunSession::to_the_end() {
  terminal_.show_mission(world_.description());
  const Instant begin = world_.clock().now();
  scheduler_ = Scheduler(begin, view_.inputs.robot.cycle);
  loop_.open(begin);
  if (world_.own_time()) {
    for (int cycle = 0; one_cycle(); ++cycle) {
      if (cycle % kObserveEveryCycles == 0) {
        observe(0);
      }
    }
  } else {
    std::atomic<bool> running{true};
    std::thread loop([&] {
      while (one_cycle()) {
      }
      running.store(false);
    });
    try {
      while (running.load()) {
        observe(kObserveEveryMs);
      }
    } catch (...) {  // out of memory, say: the loop goes on until the robot stands
      loop_.request_stop();
      loop.join();
      throw;
    }
    loop.join();
  }
  observe(0);
}

int RunSession::write_and_tell() {
  const LoopStatus& status = loop_.status();
  const RunOutcome outcome = outcome_of(view_, status, world_.stalled());
  const planner::Plan* plan = status.plan_ready ? &loop_.plan() : nullptr;
  if (plan != nullptr) {
    show_plan_once(status);
  }
  question_.close();
  terminal_.show_result(outcome, status, plan, world_.lapses());
  write("report.json", report_json(report_document(view_, plan, status, outcome)));
  if (plan != nullptr) {
    write_picture(*plan, status, outcome);
  }
  const Result<void> recorded = log_.close();
  recorded ? terminal_.show_file(path_of("events.jsonl")) : note(recorded.error());
  if (record_ != nullptr) {
    const Result<void> closed = record_->close();
    say("recorded", record_->summary());
    if (!closed) {
      note(closed.error());
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

bool RunSession::one_cycle() {
  hal::Clock& clock = world_.clock();
  const Instant started = clock.now();
  loop_.cycle(started, skipped_);
  world_.after_cycle(loop_);
  if (loop_.finished() || world_.stalled()) {
    return false;
  }
  skipped_ = scheduler_.advance(started, clock.now());
  clock.sleep_until(scheduler_.deadline());
  return true;
}

// `wait_ms`: how long to sleep while time goes on without us.
void RunSession::observe(int wait_ms) {
  log_.drain(loop_.events());
  if (record_ != nullptr) {
    record_->drain();
  }
  const LoopStatus& status = loop_.status();
  bool waited = false;
  switch (status.mode) {
    case Mode::kPlanning:
      terminal_.show_planning(status.planning);
      break;
    case Mode::kStarting:
      show_plan_once(status);
      if (answered_) {  // the drives were ready, and are not any more: what was said counts for nothing
        answered_ = false;
        question_ = {};
      }
      terminal_.show_starting(status);
      break;
    case Mode::kAwaitingConsent:
      show_plan_once(status);
      waited = seek_consent();
      break;
    case Mode::kSearching:
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
  if (wait_ms > 0 && !waited) {
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
  }
}

void RunSession::show_plan_once(const LoopStatus& status) {
  if (plan_shown_) {
    return;
  }
  plan_shown_ = true;
  terminal_.show_plan(loop_.plan());
  write("plan.json", plan_json(plan_document(view_, loop_.plan(), {status.planning.generation})));
  write_picture(loop_.plan(), status, {RunEnd::kNoConsent, "the plans, before anybody consented"});
  if (write_failed_) {  // nobody agrees to what cannot be kept
    (void)loop_.command(OperatorCommand::kPlanNotKept);
  }
}

void RunSession::write_picture(const planner::Plan& plan, const LoopStatus& status, const RunOutcome& outcome) {
  const Result<std::string> picture = picture_png(picture_of(view_, plan, status, outcome, log_.tracks()));
  picture ? write("search.png", picture.value()) : note(picture.error());
}

// True when it waited for an answer.
bool RunSession::seek_consent() {
  if (answered_ || write_failed_) {
    return false;
  }
  if (options_.yes && !consented_before_) {
    answered_ = loop_.command(OperatorCommand::kConsent);
    return false;
  }
  if (!ConsentQuestion::possible()) {
    answered_ = loop_.command(OperatorCommand::kNoConsent);
    return false;
  }
  if (!question_.asked()) {
    question_.ask("consent", consented_before_ ? "Go on with the search? The robot will move; Ctrl-C stops it. [y/N] "
                                               : "Start the search? The robot will move; Ctrl-C stops it. [y/N] ");
  }
  const Answer answer = question_.poll(kObserveEveryMs);
  if (answer != Answer::kNone) {
    answered_ = loop_.command(answer == Answer::kYes ? OperatorCommand::kConsent : OperatorCommand::kNoConsent);
  }
  return true;
}

// True when it waited for an answer.
bool RunSession::seek_clearing(const LoopStatus& status) {
  const bool being_cleared = clear_asked_at_ && status.at - *clear_asked_at_ < kClearingTakes;
  if (!ConsentQuestion::possible() || status.finished || being_cleared) {
    return false;
  }
  const std::uint8_t turning = status.drive_fault.turning_node_id;
  const bool news = std::exchange(turning_told_, turning) != turning && turning != 0;
  if (!clear_question_.asked() || news) {
    clear_question_.close();
    terminal_.end_line();
    terminal_.show_fault(status);
    clear_question_.ask("fault", "Start the drives up again? Nothing moves before you consent anew. [y/N] ");
  }
  const Answer answer = clear_question_.poll(kObserveEveryMs);
  if (answer == Answer::kYes) {
    (void)loop_.command(OperatorCommand::kClearFault);
    clear_asked_at_ = status.at;
    clear_question_ = {};
    question_ = {};
    answered_ = false;
    consented_before_ = true;
  } else if (answer == Answer::kNo) {
    loop_.request_stop();
  }
  return true;
}

void RunSession::write(const char* name, const std::string& contents) {
  const Result<void> written = write_file(path_of(name), contents);
  written ? terminal_.show_file(path_of(name)) : note(written.error());
}

void RunSession::note(const Error& error) {
  write_failed_ = true;
  terminal_.end_line();
  complain(error);
}

}  // namespace ivo::firmware
