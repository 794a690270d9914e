// How the controller is, for the tools of ROS that show diagnostics.
#pragma once

#include <string>

#include "firmware/web/ros/ros_messages.hpp"
#include "firmware/web/ros/value_writer.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

/// diagnostic_msgs/DiagnosticArray: controller, drives, bus, loop and planner.
void write_diagnostics(ValueWriter& writer, const View& view, const std::string& mission, const RosStamp& stamp);

}  // namespace ivo::firmware::web
