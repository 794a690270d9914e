// Areas as markers, which RViz, Foxglove and ros3djs draw.
#pragma once

#include <vector>

#include "firmware/web/ros/ros_documents.hpp"
#include "firmware/web/ros/ros_messages.hpp"
#include "firmware/web/ros/ros_mission.hpp"
#include "firmware/web/ros/value_writer.hpp"

namespace ivo::firmware::web {

/// visualization_msgs/MarkerArray: one that deletes all before it, then a closed line an area; ns is "preferred" or
/// "no_go", id the slot, text the agent's name.
void write_markers(ValueWriter& writer, const std::vector<RosArea>& areas, const RosMission& mission,
                   const RosStamp& stamp);

}  // namespace ivo::firmware::web
