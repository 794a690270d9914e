// Looks before anything is sent that could matter: is a controller running, is a drive in fault?
#pragma once

#include "config/base/result.hpp"
#include "firmware/tools/wheels/node_scan.hpp"
#include "firmware/tools/wheels/wheels_world.hpp"

namespace ivo::firmware::wheels {

/// Lets a scan run to its end in the world's time; ends early with what there is when a stop signal came.
void run_scan(World& world, NodeScan& scan);

/// Refuses to start the drives when a controller is running on the bus or a drive is in fault. Drives that do not
/// answer are left to the start-up, which says at which step it failed.
[[nodiscard]] Result<void> look_before_start(World& world);

}  // namespace ivo::firmware::wheels
