#include "firmware/web/ros/ros_markers.hpp"

#include <string_view>

namespace ivo::firmware::web {
namespace {

// Of visualization_msgs/Marker.
constexpr int kLineStrip = 4;
constexpr int kAdd = 0;
constexpr int kDeleteAll = 3;

struct MarkerColour {
  double r = 0.0;
  double g = 0.0;
  double b = 0.0;
};

void write_colour(ValueWriter& writer, const MarkerColour& colour) {
  writer.begin_object("color").add("r", colour.r).add("g", colour.g).add("b", colour.b).add("a", 1.0).end_object();
}

void write_marker(ValueWriter& writer, const RosStamp& stamp, int action, const RosArea* area,
                  const RosMission& mission) {
  const bool no_go = area != nullptr && area->no_go;
  const bool somebodys = area != nullptr && area->agent && *area->agent < mission.agents.size();
  RosStamp no_time = stamp;
  no_time.since_epoch = {};
  writer.begin_object();
  write_header(writer, stamp);
  writer.add("ns", area == nullptr ? "" : no_go ? "no_go" : "preferred");
  writer.add("id", area == nullptr ? 0 : int{area->slot}).add("type", kLineStrip).add("action", action);
  write_pose(writer, "pose", {});
  write_vector(writer, "scale", 0.05, 0.0, 0.0);
  write_colour(writer, no_go ? MarkerColour{0.8, 0.2, 0.2} : MarkerColour{0.1, 0.6, 0.3});
  write_time(writer, "lifetime", no_time);
  writer.add("frame_locked", false).begin_list("points");
  if (area != nullptr && !area->polygon.empty()) {
    for (std::size_t i = 0; i <= area->polygon.size(); ++i) {
      const Point corner = mission.to_ros(area->polygon[i % area->polygon.size()]);
      writer.begin_object();
      writer.add("x", corner.x_m).add("y", corner.y_m).add("z", 0.0).end_object();
    }
  }
  writer.end_list();
  writer.begin_list("colors").end_list();
  writer.add("text", somebodys ? std::string_view(mission.agents[*area->agent].name) : std::string_view{});
  writer.add("mesh_resource", "").add("mesh_use_embedded_materials", false).end_object();
}

}  // namespace

void write_markers(ValueWriter& writer, const std::vector<RosArea>& areas, const RosMission& mission,
                   const RosStamp& stamp) {
  writer.begin_object();
  writer.begin_list("markers");
  write_marker(writer, stamp, kDeleteAll, nullptr, mission);
  for (const RosArea& area : areas) {
    write_marker(writer, stamp, kAdd, &area, mission);
  }
  writer.end_list();
  writer.end_object();
}

}  // namespace ivo::firmware::web
