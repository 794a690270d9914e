#include <atomic>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>

#include "config/rates.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/tools/event_log.hpp"
#include "firmware/tools/frame_record.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/real_time_use.hpp"
#include "firmware/tools/resume/search_keeper.hpp"
#include "firmware/tools/resume/search_world.hpp"
#include "firmware/tools/run_console.hpp"
#include "firmware/tools/run_documents.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_session.hpp"
#include "firmware/tools/run_setup.hpp"
#include "firmware/tools/run_terminal.hpp"
#include "firmware/tools/run_world.hpp"
#include "firmware/tools/supervisor.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/trace/run_trace.hpp"

namespace ivo::firmware {
namespace {

std::atomic<ControlLoop*> running_loop{nullptr};
std::atomic<bool> stop_wanted{false};
static_assert(std::atomic<ControlLoop*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler uses them");

extern "C" void on_stop_signal(int /*number*/) {
  stop_wanted.store(true);
  if (ControlLoop* const loop = running_loop.load()) {
    loop->request_stop();
  }
}

// Every key with which a person in a hurry ends or suspends a program stops the robot.
void handle_stop_signals() {
  struct sigaction action {};
  action.sa_handler = on_stop_signal;  // without SA_RESTART: a wait for an answer ends
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP}) {
    (void)sigaction(number, &action, nullptr);
  }
  action.sa_handler = SIG_IGN;  // a reader of our output that goes away does not end a search
  (void)sigaction(SIGPIPE, &action, nullptr);
}

void stop_on_signals(ControlLoop& loop) {
  running_loop.store(&loop);
  if (stop_wanted.load()) {  // before there was a loop
    loop.request_stop();
  }
}

Result<std::optional<hal::WatchdogDevice>> open_watchdog(const std::string& path) {
  if (path.empty()) {
    return std::optional<hal::WatchdogDevice>();
  }
  Result<hal::WatchdogDevice> device = hal::WatchdogDevice::open(path, rates::kMachineWatchdog);
  if (!device) {
    return device.error();
  }
  return std::optional(std::move(device).value());
}

std::vector<std::string> names_of(const Mission& mission) {
  std::vector<std::string> names;
  for (const AgentSpec& agent : mission.agents) {
    names.push_back(agent.name);
  }
  return names;
}

}  // namespace

int run(const RunOptions& given) {
  RunOptions options = given;
  Result<MissionInputs> read = read_inputs(options.mission);
  if (!read) {
    return refuse(read.error());
  }
  MissionInputs inputs = std::move(read).value();                  // people may draw other areas than it has
  Result<hal::ServiceNotify> notify = hal::ServiceNotify::open();  // before there is another thread
  if (!notify) {
    return refuse(notify.error());
  }
  Result<std::unique_ptr<RunWorld>> world = RunWorld::open(options, inputs.robot);
  if (!world) {
    return refuse(world.error());
  }
  planner::Planner& planner = the_planner();  // its pages are chosen before memory is locked
  Result<RealTimeUse> real_time = real_time_use(world.value()->time(), inputs.robot.loop, options.no_real_time);
  if (!real_time) {
    return refuse(real_time.error());
  }
  if (const Result<void> prepared = prepare(planner, inputs); !prepared) {
    return refuse(prepared.error());
  }
  Result<std::optional<console::Listener>> listener = RunConsole::listen(options);
  if (!listener) {
    return refuse(listener.error());
  }

  // It counts from now on: who is told to stop ends it in order, and a refusal resets no machine.
  handle_stop_signals();
  Result<std::optional<hal::WatchdogDevice>> watchdog = open_watchdog(options.watchdog);
  if (!watchdog) {
    return refuse(watchdog.error());
  }
  const auto refuse_in_order = [&](const Error& error) {
    if (watchdog.value()) {
      (void)watchdog.value()->end();
    }
    return refuse(error);
  };
  if (options.out.empty()) {
    options.out = "out/" + std::filesystem::path(options.mission).stem().string();
  }
  if (const Result<void> made = make_folder(options.out); !made) {
    return refuse_in_order(made.error());
  }
  Result<EventLog> log = EventLog::open(options.out + "/events.jsonl", names_of(inputs.file.mission));
  if (!log) {
    return refuse_in_order(log.error());
  }
  const Result<std::unique_ptr<FrameRecord>> record = FrameRecord::open(options, *world.value());
  if (!record) {
    return refuse_in_order(record.error());
  }
  const Result<std::unique_ptr<RunTrace>> trace = RunTrace::open(options, *world.value(), inputs, planner);
  if (!trace) {
    return refuse_in_order(trace.error());
  }
  const SearchObject object = object_of(inputs.file.mission, planner);
  LoopSetup setup = loop_setup(inputs, object, *world.value());
  setup.fault_waits = ConsentQuestion::possible() || !options.console.empty();
  const Result<std::unique_ptr<SearchKeeper>> keeper = SearchKeeper::open(
      options, inputs, {setup.start, setup.searchers, search_world(options, world.value()->time())}, log.value());
  if (!keeper) {
    return refuse_in_order(keeper.error());
  }
  if (watchdog.value()) {
    (void)watchdog.value()->feed();  // a slow disk has taken of its time
  }
  // What an earlier run left here would be taken for this one's.
  if (keeper.value()->resumed() == nullptr) {
    for (const char* name : {"/plan.json", "/report.json", "/search.png"}) {
      std::error_code ignored;
      std::filesystem::remove(options.out + name, ignored);
    }
  }

  if (record.value()) {
    record.value()->start();
  }
  hal::CanBus& bus = record.value() ? record.value()->bus() : world.value()->bus();
  setup.resumed = keeper.value()->resumed();
  trace.value()->start(setup.resumed);
  setup.tracer = trace.value()->tracer();
  const auto loop = std::make_unique<ControlLoop>(setup, planner, trace.value()->bus(bus));
  stop_on_signals(*loop);
  const RunView view{{inputs, planner}, object};
  std::optional<RunConsole> console;
  if (listener.value()) {
    console.emplace(std::move(*listener.value()), *loop, inputs, planner, object);
    if (const Result<void> drawn =
            console->dialogue().keep_areas_at(options.out + "/areas.geojson", keeper.value()->taken_up());
        !drawn) {
      running_loop.store(nullptr);
      return refuse_in_order(drawn.error());
    }
    console->dialogue().take_up(log.value().tracks());
  }
  RunSession session(options, view, *loop, *world.value(), std::move(real_time).value(), std::move(log).value(),
                     *keeper.value(), record.value().get(), *trace.value(), console ? &*console : nullptr);
  Supervisor supervisor([&] { return session.loop_ended() ? std::nullopt : std::optional(loop->cycles()); },
                        std::move(notify).value(), std::move(watchdog).value());
  session.show_modes_by([&](std::string_view mode) { supervisor.say(mode); });
  supervisor.start();
  session.to_the_end();
  supervisor.stop();
  if (supervisor.lost() > 0) {
    complain({"the service manager or the watchdog did not take what it was told; expected one that listens"});
  }
  const int status = session.write_and_tell();
  running_loop.store(nullptr);
  return status;
}

}  // namespace ivo::firmware
