#include "firmware/web/ros/ros_messages.hpp"

#include <cmath>

namespace ivo::firmware::web {

void write_time(ValueWriter& writer, std::string_view key, const RosStamp& stamp) {
  constexpr Duration::rep kSecond = 1'000'000'000;
  const Duration::rep ns = stamp.since_epoch.count();
  writer.begin_object(key).add(stamp.ros2 ? "sec" : "secs", std::int64_t{ns / kSecond});
  writer.add(stamp.ros2 ? "nanosec" : "nsecs", std::int64_t{ns % kSecond}).end_object();
}

void write_header(ValueWriter& writer, const RosStamp& stamp, std::string_view frame) {
  writer.begin_object("header");
  if (!stamp.ros2) {
    writer.add("seq", std::int64_t{stamp.sequence});
  }
  write_time(writer, "stamp", stamp);
  writer.add("frame_id", frame).end_object();
}

void write_vector(ValueWriter& writer, std::string_view key, double x, double y, double z) {
  writer.begin_object(key).add("x", x).add("y", y).add("z", z).end_object();
}

void write_pose(ValueWriter& writer, std::string_view key, const Pose& pose) {
  writer.begin_object(key);
  write_vector(writer, "position", pose.x_m, pose.y_m, 0.0);
  writer.begin_object("orientation").add("x", 0.0).add("y", 0.0);
  writer.add("z", std::sin(pose.heading_rad / 2)).add("w", std::cos(pose.heading_rad / 2)).end_object();
  writer.end_object();
}

void write_grid(ValueWriter& writer, const RosStamp& stamp, const GridPlace& place,
                const std::vector<std::int8_t>& values) {
  writer.begin_object();
  write_header(writer, stamp);
  writer.begin_object("info");
  write_time(writer, "map_load_time", stamp);
  writer.add("resolution", place.side_m).add("width", place.columns).add("height", place.rows);
  write_pose(writer, "origin", {place.origin_m.x_m, place.origin_m.y_m, 0.0});
  writer.end_object();
  writer.key("data");
  writer.bytes(values);
  writer.end_object();
}

void write_path(ValueWriter& writer, const RosStamp& stamp, const std::vector<Point>& waypoints) {
  writer.begin_object();
  write_header(writer, stamp);
  writer.begin_list("poses");
  double heading_rad = 0.0;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Point here = waypoints[i];
    if (i + 1 < waypoints.size() && waypoints[i + 1] != here) {
      heading_rad = std::atan2(waypoints[i + 1].y_m - here.y_m, waypoints[i + 1].x_m - here.x_m);
    }
    writer.begin_object();
    write_header(writer, stamp);
    write_pose(writer, "pose", {here.x_m, here.y_m, heading_rad});
    writer.end_object();
  }
  writer.end_list();
  writer.end_object();
}

void write_floats(ValueWriter& writer, const GridPlace& place, const std::vector<float>& values) {
  const auto dimension = [&](const char* label, int size, int stride) {
    writer.begin_object();
    writer.add("label", label).add("size", size).add("stride", stride).end_object();
  };
  writer.begin_object();
  writer.begin_object("layout").begin_list("dim");
  dimension("rows", place.rows, place.rows * place.columns);
  dimension("columns", place.columns, place.columns);
  writer.end_list();
  writer.add("data_offset", 0).end_object();
  writer.key("data");
  writer.floats(values);
  writer.end_object();
}

}  // namespace ivo::firmware::web
