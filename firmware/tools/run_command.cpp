#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>
#include <variant>

#include "config/rates.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/loop/scheduler.hpp"
#include "firmware/tools/event_log.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/frame_record.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/run_documents.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_terminal.hpp"
#include "firmware/tools/run_world.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

constexpr int kObserveEveryMs = 50;
constexpr int kObserveEveryCycles = 25;
constexpr Duration kClearingTakes =
    std::chrono::seconds(10);  // a quick stop's time and a start-up's; then we ask again

std::atomic<ControlLoop*> running_loop{nullptr};
static_assert(std::atomic<ControlLoop*>::is_always_lock_free, "a signal handler reads it");

extern "C" void on_stop_signal(int /*number*/) {
  if (ControlLoop* const loop = running_loop.load()) {
    loop->request_stop();
  }
}

// Every key with which a person in a hurry ends or suspends a program stops the robot.
void stop_on_signals(ControlLoop& loop) {
  running_loop.store(&loop);
  struct sigaction action {};
  action.sa_handler = on_stop_signal;  // without SA_RESTART: a wait for an answer ends
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP}) {
    (void)sigaction(number, &action, nullptr);
  }
  action.sa_handler = SIG_IGN;  // a reader of our output that goes away does not end a search
  (void)sigaction(SIGPIPE, &action, nullptr);
}

SearchObject object_of(const Mission& mission, const planner::Planner& planner) {
  if (const Point* place = std::get_if<Point>(&mission.object)) {
    return {*place, mission.find};
  }
  if (std::holds_alternative<ObjectDrawn>(mission.object)) {
    return SearchObject::drawn(planner.cells(), planner.belief(), mission.seed, mission.find);
  }
  return {};
}

LoopSetup setup_of(const MissionInputs& inputs, const SearchObject& object) {
  LoopSetup setup{.robot = inputs.robot, .start = {}, .searchers = {}, .object = object};
  for (const AgentSpec& agent : inputs.file.mission.agents) {
    IVO_CONTRACT(setup.searchers.push_back({.kind = agent.kind,
                                            .motion = agent.motion,
                                            .start = agent.start,
                                            .speed_mps = agent.speed_mps,
                                            .sight_radius_m = agent.sight_radius_m}));
  }
  const AgentSpec& robot = inputs.file.mission.agents.front();
  setup.start = {robot.start.x_m, robot.start.y_m, robot.heading_rad};
  setup.fault_waits = ConsentQuestion::possible();
  return setup;
}

std::vector<std::string> names_of(const Mission& mission) {
  std::vector<std::string> names;
  for (const AgentSpec& agent : mission.agents) {
    names.push_back(agent.name);
  }
  return names;
}

/// One run, seen from outside the loop: shows, asks, records, and writes what is left of it.
class Run {
 public:
  /// `record` may be null.
  Run(const RunOptions& options, const RunView& view, ControlLoop& loop, RunWorld& world, EventLog log,
      FrameRecord* record)
      : options_(options),
        view_(view),
        loop_(loop),
        world_(world),
        log_(std::move(log)),
        record_(record),
        terminal_(view) {}

  void to_the_end() {
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

  int write_and_tell() {
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

  [[nodiscard]] std::string path_of(const char* name) const { return options_.out + "/" + name; }

 private:
  bool one_cycle() {
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

  /// `wait_ms`: how long to sleep while time goes on without us.
  void observe(int wait_ms) {
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

  void show_plan_once(const LoopStatus& status) {
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

  void write_picture(const planner::Plan& plan, const LoopStatus& status, const RunOutcome& outcome) {
    const Result<std::string> picture = picture_png(picture_of(view_, plan, status, outcome, log_.tracks()));
    picture ? write("search.png", picture.value()) : note(picture.error());
  }

  /// True when it waited for an answer.
  bool seek_consent() {
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

  /// True when it waited for an answer.
  bool seek_clearing(const LoopStatus& status) {
    const bool being_cleared = clear_asked_at_ && status.at - *clear_asked_at_ < kClearingTakes;
    if (!ConsentQuestion::possible() || status.finished || being_cleared) {
      return false;
    }
    if (!clear_question_.asked()) {
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

  void write(const char* name, const std::string& contents) {
    const Result<void> written = write_file(path_of(name), contents);
    written ? terminal_.show_file(path_of(name)) : note(written.error());
  }

  void note(const Error& error) {
    write_failed_ = true;
    terminal_.end_line();
    complain(error);
  }

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
  bool consented_before_ = false;  // and a fault has ended that: --yes was for the first time
  Scheduler scheduler_{Instant{}, rates::kCycle};
  std::int64_t skipped_ = 0;
  bool plan_shown_ = false;
  bool answered_ = false;
  bool write_failed_ = false;
};

}  // namespace

int run(const RunOptions& given) {
  RunOptions options = given;
  Result<MissionInputs> read = read_inputs(options.mission);
  if (!read) {
    return refuse(read.error());
  }
  const MissionInputs inputs = std::move(read).value();
  Result<std::unique_ptr<RunWorld>> world = RunWorld::open(options, inputs.robot);
  if (!world) {
    return refuse(world.error());
  }
  planner::Planner& planner = the_planner();
  if (const Result<void> prepared = prepare(planner, inputs); !prepared) {
    return refuse(prepared.error());
  }

  if (options.out.empty()) {
    options.out = "out/" + std::filesystem::path(options.mission).stem().string();
  }
  if (const Result<void> made = make_folder(options.out); !made) {
    return refuse(made.error());
  }
  Result<EventLog> log = EventLog::create(options.out + "/events.jsonl", names_of(inputs.file.mission));
  if (!log) {
    return refuse(log.error());
  }
  const Result<std::unique_ptr<FrameRecord>> record = FrameRecord::open(options, *world.value());
  if (!record) {
    return refuse(record.error());
  }
  // What an earlier run left here would be taken for this one's.
  for (const char* name : {"/plan.json", "/report.json", "/search.png"}) {
    std::error_code ignored;
    std::filesystem::remove(options.out + name, ignored);
  }

  const SearchObject object = object_of(inputs.file.mission, planner);
  hal::CanBus& bus = record.value() ? record.value()->bus() : world.value()->bus();
  LoopSetup setup = setup_of(inputs, object);
  setup.inputs = world.value()->inputs();
  const auto loop = std::make_unique<ControlLoop>(setup, planner, bus);
  stop_on_signals(*loop);
  const RunView view{{inputs, planner}, object};
  Run the_run(options, view, *loop, *world.value(), std::move(log).value(), record.value().get());
  the_run.to_the_end();
  const int status = the_run.write_and_tell();
  running_loop.store(nullptr);
  return status;
}

}  // namespace ivo::firmware
