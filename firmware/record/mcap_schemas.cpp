#include "firmware/record/mcap_schemas.hpp"

#include <initializer_list>

#include "firmware/record/json_text.hpp"

namespace ivo::firmware::mcap_schemas {
namespace {

struct Member {
  std::string name;
  std::string type;  // a schema
};

const std::string kNumber = R"({"type":"number"})";
const std::string kInteger = R"({"type":"integer"})";
const std::string kText = R"({"type":"string"})";

std::string object(std::span<const Member> members) {
  JsonText properties;
  for (const Member& member : members) {
    properties.raw(member.name, member.type);
  }
  return JsonText().add("type", "object").raw("properties", properties.done()).done();
}
std::string object(std::initializer_list<Member> members) {
  return object(std::span<const Member>(members.begin(), members.size()));
}
std::string array_of(const std::string& type) { return JsonText().add("type", "array").raw("items", type).done(); }

std::string time() { return object({{"sec", kInteger}, {"nsec", kInteger}}); }
std::string vector() { return object({{"x", kNumber}, {"y", kNumber}, {"z", kNumber}}); }
std::string quaternion() { return object({{"x", kNumber}, {"y", kNumber}, {"z", kNumber}, {"w", kNumber}}); }
std::string pose() { return object({{"position", vector()}, {"orientation", quaternion()}}); }

}  // namespace

McapFile::Schema pose_in_frame() {
  return {"foxglove.PoseInFrame", object({{"timestamp", time()}, {"frame_id", kText}, {"pose", pose()}})};
}

McapFile::Schema poses_in_frame() {
  return {"foxglove.PosesInFrame", object({{"timestamp", time()}, {"frame_id", kText}, {"poses", array_of(pose())}})};
}

McapFile::Schema frame_transform() {
  return {"foxglove.FrameTransform", object({{"timestamp", time()},
                                             {"parent_frame_id", kText},
                                             {"child_frame_id", kText},
                                             {"translation", vector()},
                                             {"rotation", quaternion()}})};
}

McapFile::Schema grid() {
  return {"foxglove.Grid",
          object({{"timestamp", time()},
                  {"frame_id", kText},
                  {"pose", pose()},
                  {"column_count", kInteger},
                  {"cell_size", object({{"x", kNumber}, {"y", kNumber}})},
                  {"row_stride", kInteger},
                  {"cell_stride", kInteger},
                  {"fields", array_of(object({{"name", kText}, {"offset", kInteger}, {"type", kInteger}}))},
                  {"data", JsonText().add("type", "string").add("contentEncoding", "base64").done()}})};
}

McapFile::Schema log() {
  return {"foxglove.Log", object({{"timestamp", time()},
                                  {"level", kInteger},
                                  {"message", kText},
                                  {"name", kText},
                                  {"file", kText},
                                  {"line", kInteger}})};
}

McapFile::Schema command() {
  return {"ivo.Command", object({{"vx_mps", kNumber}, {"vy_mps", kNumber}, {"wz_radps", kNumber}})};
}

McapFile::Schema wheels(std::span<const std::string> names) {
  std::vector<Member> members;
  for (const std::string& name : names) {
    members.push_back({name, object({{"told_radps", kNumber}, {"angle_rad", kNumber}})});
  }
  return {"ivo.Wheels", object(members)};
}

McapFile::Schema timing(std::span<const std::string> phases) {
  std::vector<Member> members;
  for (const std::string& phase : phases) {
    members.push_back({phase, kNumber});
  }
  return {"ivo.Timing", object({{"cycle_us", kNumber},
                                {"wake_up_latency_us", kNumber},
                                {"skipped", kInteger},
                                {"planner_units", kInteger},
                                {"planner_moves", kInteger},
                                {"phases_us", object(members)}})};
}

}  // namespace ivo::firmware::mcap_schemas
