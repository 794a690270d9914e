#include <atomic>
#include <csignal>
#include <filesystem>
#include <memory>
#include <variant>

#include "firmware/files/text_file.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/tools/event_log.hpp"
#include "firmware/tools/frame_record.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/run_documents.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_session.hpp"
#include "firmware/tools/run_terminal.hpp"
#include "firmware/tools/run_world.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

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
  RunSession session(options, view, *loop, *world.value(), std::move(log).value(), record.value().get());
  session.to_the_end();
  const int status = session.write_and_tell();
  running_loop.store(nullptr);
  return status;
}

}  // namespace ivo::firmware
