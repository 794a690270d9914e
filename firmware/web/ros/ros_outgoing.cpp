#include "firmware/web/ros/ros_outgoing.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "firmware/safety/mode.hpp"
#include "firmware/web/ros/ros_diagnostics.hpp"
#include "firmware/web/ros/ros_documents.hpp"
#include "firmware/web/ros/ros_grids.hpp"
#include "firmware/web/ros/ros_markers.hpp"

namespace ivo::firmware::web {
namespace {

using console::Document;

const std::string& bytes_of(const View& view, Document which) {
  static const std::string kNothing;
  return view.document(which).bytes == nullptr ? kNothing : *view.document(which).bytes;
}

GridPlace map_place(const RosMission& mission) {
  return {mission.width_px, mission.height_px, mission.resolution_m, mission.origin_m};
}
GridPlace cell_place(const RosMission& mission) {
  return {mission.columns, mission.rows, mission.cell_m, mission.origin_m};
}

bool write_pixels(ValueWriter& writer, const RosMission& mission, const RosStamp& stamp,
                  const std::vector<std::int8_t>& values) {
  if (values.empty()) {
    return false;
  }
  write_grid(writer, stamp, map_place(mission), values);
  return true;
}

bool write_cells(ValueWriter& writer, bool as_mass, const RosMission& mission, const RosStamp& stamp,
                 const std::vector<float>& values) {
  if (values.empty()) {
    return false;
  }
  if (as_mass) {
    write_floats(writer, cell_place(mission), values);
  } else {
    write_grid(writer, stamp, cell_place(mission), percent_of_most(values));
  }
  return true;
}

/// Empty before there is a plan.
bool write_plan(ValueWriter& writer, std::size_t agent, const View& view, const RosMission& mission,
                const RosStamp& stamp) {
  const std::vector<std::vector<Point>> plans = waypoints_of(bytes_of(view, Document::kPlan));
  std::vector<Point> waypoints = agent < plans.size() ? plans[agent] : std::vector<Point>{};
  for (Point& waypoint : waypoints) {
    waypoint = mission.to_ros(waypoint);
  }
  write_path(writer, stamp, waypoints);
  return true;
}

Pose status_pose(std::size_t agent, const console::Status& status, const RosMission& mission) {
  const Point place = mission.to_ros({status.agent[agent].x_m, status.agent[agent].y_m});
  return {place.x_m, place.y_m, agent == 0 ? status.heading_rad : 0.0};
}

bool write_agent_pose(ValueWriter& writer, std::size_t agent, const View& view, const RosMission& mission,
                      const RosStamp& stamp) {
  if (!view.status || agent >= view.status->agents || agent >= view.status->agent.size()) {
    return false;
  }
  writer.begin_object();
  write_header(writer, stamp);
  write_pose(writer, "pose", status_pose(agent, *view.status, mission));
  writer.end_object();
  return true;
}

bool write_transform(ValueWriter& writer, const View& view, const RosMission& mission, const RosStamp& stamp) {
  if (!view.status || view.status->agents == 0) {
    return false;
  }
  const Pose robot = status_pose(0, *view.status, mission);
  writer.begin_object();
  writer.begin_list("transforms").begin_object();
  write_header(writer, stamp);
  writer.add("child_frame_id", "base_link").begin_object("transform");
  write_vector(writer, "translation", robot.x_m, robot.y_m, 0.0);
  writer.begin_object("rotation").add("x", 0.0).add("y", 0.0);
  writer.add("z", std::sin(robot.heading_rad / 2)).add("w", std::cos(robot.heading_rad / 2)).end_object();
  writer.end_object();
  writer.end_object();
  writer.end_list();
  writer.end_object();
  return true;
}

/// Of documents of which none may be missing; grows when one of them changes.
std::uint64_t newest(const View& view, std::initializer_list<Document> needed) {
  std::uint64_t sum = 0;
  for (const Document which : needed) {
    if (view.document(which).bytes == nullptr) {
      return 0;
    }
    sum += view.document(which).revision;
  }
  return sum;
}

}  // namespace

std::string_view state_text(const View& view) {
  switch (view.link) {
    case LinkState::kNone:
      return "no controller yet";
    case LinkState::kSilent:
      return "controller silent";
    case LinkState::kAbsent:
      return "no controller";
    case LinkState::kConnected:
      break;
  }
  return view.status && view.status->mode < kModes ? name_of(static_cast<Mode>(view.status->mode)) : "unknown";
}

std::uint64_t version_of(Outgoing what, const View& view, Instant now) {
  const std::uint64_t searched = view.document(Document::kSearched).revision;
  switch (what) {
    case Outgoing::kMap:
      return newest(view, {Document::kMission, Document::kMap});
    case Outgoing::kProbability:
    case Outgoing::kProbabilityMass:
      return newest(view, {Document::kMission, Document::kProbability});
    case Outgoing::kBelief:
    case Outgoing::kBeliefMass: {
      const std::uint64_t masses = newest(view, {Document::kMission, Document::kProbability});
      return masses == 0 ? 0 : masses + searched;
    }
    case Outgoing::kNoGo:
      return newest(view, {Document::kMission, Document::kMap, Document::kAreas});
    case Outgoing::kAreas:
      return newest(view, {Document::kMission, Document::kAreas});
    case Outgoing::kPlan:
      return newest(view, {Document::kMission, Document::kPlan});
    case Outgoing::kPose:
    case Outgoing::kTransform:
      return view.status && view.document(Document::kMission).there() ? view.statuses : 0;
    case Outgoing::kState: {
      const std::uint64_t mode = view.status ? view.status->mode : 255;
      return 1 + static_cast<std::uint64_t>(view.link) * 256 + mode;
    }
    case Outgoing::kDiagnostics:
      return 1 + static_cast<std::uint64_t>(now.time_since_epoch() / std::chrono::seconds(1));
  }
  return 0;
}

Duration least_period_of(Outgoing what) {
  const bool grid = what == Outgoing::kMap || what == Outgoing::kProbability || what == Outgoing::kProbabilityMass ||
                    what == Outgoing::kBelief || what == Outgoing::kBeliefMass || what == Outgoing::kNoGo;
  return grid ? std::chrono::milliseconds(200) : Duration{};
}

bool write_message(ValueWriter& writer, Outgoing what, std::optional<std::size_t> agent, const View& view,
                   const RosMission& mission, const RosStamp& stamp) {
  const auto masses = [&] { return masses_of(bytes_of(view, Document::kProbability), mission); };
  const auto belief = [&] { return belief_of(masses(), bytes_of(view, Document::kSearched)); };
  switch (what) {
    case Outgoing::kMap:
      return write_pixels(writer, mission, stamp, occupancy_of(bytes_of(view, Document::kMap), mission));
    case Outgoing::kNoGo:
      return write_pixels(
          writer, mission, stamp,
          keepout_grid_of(bytes_of(view, Document::kMap), mission, areas_of(bytes_of(view, Document::kAreas))));
    case Outgoing::kProbability:
    case Outgoing::kProbabilityMass:
      return write_cells(writer, what == Outgoing::kProbabilityMass, mission, stamp, masses());
    case Outgoing::kBelief:
    case Outgoing::kBeliefMass:
      return write_cells(writer, what == Outgoing::kBeliefMass, mission, stamp, belief());
    case Outgoing::kAreas:
      write_markers(writer, areas_of(bytes_of(view, Document::kAreas)), mission, stamp);
      return true;
    case Outgoing::kState:
      writer.begin_object();
      writer.add("data", state_text(view)).end_object();
      return true;
    case Outgoing::kDiagnostics:
      write_diagnostics(writer, view, mission.name, stamp);
      return true;
    case Outgoing::kTransform:
      return write_transform(writer, view, mission, stamp);
    case Outgoing::kPlan:
      return write_plan(writer, agent.value_or(0), view, mission, stamp);
    case Outgoing::kPose:
      return write_agent_pose(writer, agent.value_or(0), view, mission, stamp);
  }
  return false;
}

}  // namespace ivo::firmware::web
