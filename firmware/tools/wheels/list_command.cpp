#include <cstdio>
#include <memory>

#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/stop_signal.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/node_table.hpp"
#include "firmware/tools/wheels/preflight.hpp"
#include "firmware/tools/wheels/state_words.hpp"
#include "firmware/tools/wheels/wheels_options.hpp"
#include "firmware/tools/wheels/wheels_world.hpp"

namespace ivo::firmware::wheels {
namespace {

// A robot file whose drive's EDS lacks something was refused when it was read.
void say_eds(const Robot& robot) {
  for (int wheel = 0; wheel < kWheels; ++wheel) {
    if (const std::string& eds = robot.drives[static_cast<std::size_t>(wheel)].eds; !eds.empty()) {
      say("checked", std::string(name_of(static_cast<Wheel>(wheel))) + ": " + eds +
                         " has all that the controller reads and writes");
    }
  }
}

}  // namespace

int list(const Options& options) {
  const Result<std::unique_ptr<World>> world = World::open(options, World::Purpose::kLook);
  if (!world) {
    return refuse(world.error());
  }
  World& the_world = *world.value();
  say("bus", the_world.description());
  say("robot", the_world.robot().name + ", " + the_world.robot_source());
  say_eds(the_world.robot());
  stop_on_signals();
  const auto scan = std::make_unique<NodeScan>(the_world.bus(), the_world.robot(), NodeScan::everyone());
  run_scan(the_world, *scan);
  if (!scan->done()) {
    say("stopped", "before all nodes were asked");
    return exit_status::kFaultOrStop;
  }
  const NodeTable table = node_table(*scan, the_world.robot());
  if (scan->controller()) {
    say("listened", "a controller is running on this bus (heard " + controller_text(*scan->controller()) +
                        "): nobody was asked anything");
  } else {
    say("asked", "node-ids 1 to 127: " + (table.nodes == 0 ? "nobody is there" : counted(table.nodes, "node")));
  }
  if (hal::lost(the_world.bus().state())) {
    say("fault", std::string(name_of(the_world.bus().state())));
  }
  if (!table.rows.empty()) {
    (void)std::printf("\n");
    for (const std::string& row : table.rows) {
      (void)std::printf("%s\n", row.c_str());
    }
    (void)std::printf("%s\n", scan->controller() ? "" : "\n* the mode that the controller would choose\n");
  }
  for (const Remark& remark : table.remarks) {
    say(remark.label.c_str(), remark.text);
  }
  if (table.as_expected) {
    say("wheels", "all four drives are there");
  }
  return table.as_expected ? exit_status::kEnded : exit_status::kFaultOrStop;
}

}  // namespace ivo::firmware::wheels
