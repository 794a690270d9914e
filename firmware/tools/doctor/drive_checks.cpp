#include "firmware/tools/doctor/drive_checks.hpp"

#include <array>

#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/node_table.hpp"
#include "firmware/tools/wheels/state_words.hpp"

namespace ivo::firmware::doctor {
namespace {

std::string ids_text(const Robot& robot) {
  std::string ids;
  for (const DriveParameters& drive : robot.drives) {
    ids += (ids.empty() ? "" : ", ") + std::to_string(drive.node_id);
  }
  return ids;
}

std::string list_of(const std::string& can) { return "`ivo wheels list --can " + can + "` shows every node"; }

Finding of_remark(const wheels::Remark& remark, const std::string& can) {
  if (remark.label == "missing") {
    return fault("missing", remark.text, "power, wiring, node-id and bit rate of the drive; " + list_of(can));
  }
  if (remark.label == "differs") {
    return fault("differs", remark.text,
                 "the robot file, or the drive; `ivo wheels check --can " + can + "` tries each wheel");
  }
  if (remark.label == "fault") {
    return fault("in fault", remark.text, "mend its cause by the drive's manual, then power it off and on");
  }
  if (remark.label == "unknown") {
    return warning("unknown", remark.text, "take it off the bus, or its node-id into the robot file; " + list_of(can));
  }
  return fault("answers not", remark.text, "its SDO server: power it off and on; " + list_of(can));
}

}  // namespace

Group drive_checks(const NodeScan& scan, const Robot& robot, const std::string& can) {
  const wheels::NodeTable table = wheels::node_table(scan, robot);
  Group group{kDrives, {}};
  if (scan.controller()) {
    group.findings.push_back(ok("controller", "one is running (heard " + wheels::controller_text(*scan.controller()) +
                                                  "): nobody was asked anything, only listened to"));
  }
  const char* const check = scan.controller() ? "heard" : "answer";
  int there = 0;
  for (const DriveParameters& drive : robot.drives) {
    there += scan.node(drive.node_id).there() ? 1 : 0;
  }
  if (table.as_expected) {
    group.findings.push_back(ok(check, "all four: node-ids " + ids_text(robot) +
                                           (scan.controller() ? "" : "; none in fault, all as the robot file says")));
  } else if (there == 0) {
    group.findings.push_back(fault(check, "none of the four: node-ids " + ids_text(robot),
                                   "power, wiring, bit rate and node-ids of the drives; " + list_of(can)));
  } else {
    group.findings.push_back(ok(check, format("%d of four", there)));
  }
  for (const wheels::Remark& remark : table.remarks) {
    if (there == 0 && remark.label == "missing") {
      continue;  // said of all of them
    }
    group.findings.push_back(of_remark(remark, can));
  }
  return group;
}

}  // namespace ivo::firmware::doctor
