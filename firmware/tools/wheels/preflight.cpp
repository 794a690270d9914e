#include "firmware/tools/wheels/preflight.hpp"

#include <memory>

#include "firmware/tools/stop_signal.hpp"
#include "firmware/tools/wheels/node_table.hpp"
#include "firmware/tools/wheels/state_words.hpp"

namespace ivo::firmware::wheels {

void run_scan(World& world, NodeScan& scan) {
  hal::Clock& clock = world.clock();
  Instant next = clock.now();
  while (!scan.done() && !stop_asked()) {
    scan.cycle(clock.now());
    world.after_cycle();
    next += world.robot().cycle;
    clock.sleep_until(next);
  }
}

Result<void> look_before_start(World& world) {
  const Robot& robot = world.robot();
  NodeScan::NodeIds ours;
  for (const DriveParameters& drive : robot.drives) {
    ours.set(drive.node_id);
  }
  const auto scan = std::make_unique<NodeScan>(world.bus(), robot, ours);
  run_scan(world, *scan);
  if (scan->controller()) {
    return Error{"a controller is running on this bus: heard " + controller_text(*scan->controller()) +
                 "; expected to be alone, end it first"};
  }
  for (int wheel = 0; wheel < kWheels; ++wheel) {
    if (const auto fault = fault_text(*scan, robot, static_cast<Wheel>(wheel))) {
      return Error{*fault + "; expected no fault, mend it and power the drive off and on"};
    }
  }
  if (hal::lost(world.bus().state())) {
    return Error{"the bus is lost: " + std::string(name_of(world.bus().state()))};
  }
  return {};
}

}  // namespace ivo::firmware::wheels
