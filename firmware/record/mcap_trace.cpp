#include "firmware/record/mcap_trace.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "firmware/record/base64.hpp"
#include "firmware/record/mcap_schemas.hpp"

namespace ivo::firmware {
namespace {

constexpr Duration kPosesEvery = std::chrono::milliseconds(20);
constexpr const char* kMap = "map";
constexpr int kInfo = 2;  // of foxglove.Log
constexpr int kWarning = 3;
constexpr int kError = 4;
constexpr std::int64_t kFloat32 = 7;  // of foxglove.PackedElementField

std::string vector(double x, double y) { return JsonText().add("x", x).add("y", y).add("z", 0.0).done(); }
std::string quaternion(double heading_rad) {
  return JsonText()
      .add("x", 0.0)
      .add("y", 0.0)
      .add("z", std::sin(heading_rad / 2.0))
      .add("w", std::cos(heading_rad / 2.0))
      .done();
}
std::string pose_text(const Pose& pose) {
  return JsonText().raw("position", vector(pose.x_m, pose.y_m)).raw("orientation", quaternion(pose.heading_rad)).done();
}

}  // namespace

Result<McapTrace> McapTrace::create(const std::string& path, Options options) {
  Result<McapFile> file = McapFile::create(path, options.earlier);
  if (!file) {
    return file.error();
  }
  return McapTrace(std::move(file).value(), std::move(options));
}

McapTrace::McapTrace(McapFile file, Options options)
    : file_(std::move(file)),
      options_(std::move(options)),
      frames_(file_.add_channel("/tf", mcap_schemas::frame_transform())),
      belief_(file_.add_channel("/belief", mcap_schemas::grid())),
      command_(file_.add_channel("/command", mcap_schemas::command())),
      wheels_(file_.add_channel("/wheels", mcap_schemas::wheels(options_.names.wheels))),
      timing_(file_.add_channel("/timing", mcap_schemas::timing(options_.names.phases))),
      events_(file_.add_channel("/events", mcap_schemas::log())),
      now_(options_.epoch),
      next_(options_.epoch) {
  for (const std::string& name : options_.names.agents) {
    poses_.push_back(file_.add_channel("/" + name + "/pose", mcap_schemas::pose_in_frame()));
    plans_.push_back(file_.add_channel("/plan/" + name, mcap_schemas::poses_in_frame()));
  }
}

void McapTrace::take(const TraceEvent& event) {
  switch (event.kind) {
    case TraceKind::kCycleBegan:
      begin_cycle(event.get<TracedCycle>());
      break;
    case TraceKind::kCycleEnded:
      end_cycle(event);
      break;
    case TraceKind::kPhase:
      phases_.add(TraceNames::of(options_.names.phases, event.code), microseconds(Duration(event.lasted_ns)));
      break;
    case TraceKind::kMode:
      say(kInfo, "mode: " + TraceNames::of(options_.names.modes, event.code));
      break;
    case TraceKind::kFault:
      say(kError, "fault: " + options_.names.of_fault(event));
      break;
    case TraceKind::kBusState:
      say(kWarning, "bus: " + TraceNames::of(options_.names.bus_states, event.code));
      break;
    case TraceKind::kPose:
      add_pose(event.id, event.get<TracedPose>());
      break;
    case TraceKind::kCommand:
      add_command(event.get<TracedTwist>());
      break;
    case TraceKind::kToldWheels:
      told_ = event.get<TracedWheels>();
      break;
    case TraceKind::kWheelAngles:
      add_wheels(event.get<TracedWheels>());
      break;
    case TraceKind::kSlice:
    case TraceKind::kFrameIn:
    case TraceKind::kFrameOut:
      break;  // for the trace; frames have a record of their own
  }
}

void McapTrace::begin_cycle(const TracedCycle& cycle) {
  cycle_ = cycle;
  now_ = options_.epoch + Duration(cycle.loop_ns);
  due_ = now_ >= next_;
  if (due_) {
    next_ = now_ + kPosesEvery;
  }
  phases_ = JsonText();
  if (cycle.skipped > 0) {
    say(kWarning, "overrun: " + std::to_string(cycle.skipped) + " periods skipped");
  }
}

void McapTrace::end_cycle(const TraceEvent& event) {
  const TracedWork work = event.get<TracedWork>();
  file_.add_message(timing_, now_,
                    JsonText()
                        .add("cycle_us", microseconds(Duration(event.lasted_ns)))
                        .add("wake_up_latency_us", microseconds(Duration(cycle_.latency_ns)))
                        .add("skipped", cycle_.skipped)
                        .add("planner_units", work.units)
                        .add("planner_moves", work.moves)
                        .raw("phases_us", phases_.done())
                        .done());
  phases_ = JsonText();
}

void McapTrace::add_pose(std::size_t number, const TracedPose& pose) {
  if (!due_ || number >= poses_.size()) {
    return;
  }
  file_.add_message(poses_[number], now_,
                    JsonText()
                        .add("timestamp", now_)
                        .add("frame_id", kMap)
                        .raw("pose", pose_text({pose.x_m, pose.y_m, pose.heading_rad}))
                        .done());
  file_.add_message(frames_, now_,
                    JsonText()
                        .add("timestamp", now_)
                        .add("parent_frame_id", kMap)
                        .add("child_frame_id", agent(number))
                        .raw("translation", vector(pose.x_m, pose.y_m))
                        .raw("rotation", quaternion(pose.heading_rad))
                        .done());
}

void McapTrace::add_command(const TracedTwist& twist) {
  if (due_) {
    file_.add_message(
        command_, now_,
        JsonText().add("vx_mps", twist.vx_mps).add("vy_mps", twist.vy_mps).add("wz_radps", twist.wz_radps).done());
  }
}

void McapTrace::add_wheels(const TracedWheels& angles) {
  if (!due_) {
    return;
  }
  JsonText wheels;
  for (std::size_t i = 0; i < angles.wheels.size(); ++i) {
    wheels.raw(TraceNames::of(options_.names.wheels, i),
               JsonText().add("told_radps", double{told_.wheels[i]}).add("angle_rad", double{angles.wheels[i]}).done());
  }
  file_.add_message(wheels_, now_, wheels.done());
}

void McapTrace::add_plan(std::size_t agent, std::span<const Point> waypoints) {
  std::string poses;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Point from = waypoints[i];
    const Point to = waypoints[i + 1 < waypoints.size() ? i + 1 : i];
    poses += (i > 0 ? "," : "") + pose_text({from.x_m, from.y_m, std::atan2(to.y_m - from.y_m, to.x_m - from.x_m)});
  }
  file_.add_message(plans_[agent], now_,
                    JsonText().add("timestamp", now_).add("frame_id", kMap).raw("poses", "[" + poses + "]").done());
}

void McapTrace::add_belief(const Field& mass) {
  const std::string field = JsonText().add("name", "mass").add("offset", std::int64_t{0}).add("type", kFloat32).done();
  file_.add_message(belief_, now_,
                    JsonText()
                        .add("timestamp", now_)
                        .add("frame_id", kMap)
                        .raw("pose", pose_text({}))
                        .add("column_count", std::int64_t{mass.columns})
                        .raw("cell_size", JsonText().add("x", mass.cell_m).add("y", mass.cell_m).done())
                        .add("row_stride", static_cast<std::int64_t>(sizeof(float)) * mass.columns)
                        .add("cell_stride", static_cast<std::int64_t>(sizeof(float)))
                        .raw("fields", "[" + field + "]")
                        .add("data", base64(std::as_bytes(mass.values)))
                        .done());
}

void McapTrace::say(int level, const std::string& message) {
  file_.add_message(events_, now_,
                    JsonText()
                        .add("timestamp", now_)
                        .add("level", std::int64_t{level})
                        .add("message", message)
                        .add("name", "ivo")
                        .add("file", "")
                        .add("line", std::int64_t{0})
                        .done());
}

std::string McapTrace::summary() const { return std::to_string(file_.messages()) + " messages in " + file_.where(); }

}  // namespace ivo::firmware
