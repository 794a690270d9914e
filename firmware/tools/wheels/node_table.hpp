// A scan in lines for a person: the table of nodes, and what does not agree with the robot file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "firmware/tools/wheels/node_scan.hpp"

namespace ivo::firmware::wheels {

struct Remark {
  std::string label;  ///< "missing", "unknown", "differs", "fault", "note"
  std::string text;
};

struct NodeTable {
  std::vector<std::string> rows;  ///< heading first; empty when nobody is there
  std::vector<Remark> remarks;
  bool as_expected = true;  ///< every wheel has its drive, none differs or is in fault
  int nodes = 0;
};

[[nodiscard]] NodeTable node_table(const NodeScan& scan, const Robot& robot);

/// "drive 3 (rear left) is in fault (statusword 0218h), 7300h: sensor"; none when it says no such thing.
[[nodiscard]] std::optional<std::string> fault_text(const NodeScan& scan, const Robot& robot, Wheel wheel);
/// What `id` is that a controller sent: "SYNC", "a heartbeat of node 127".
[[nodiscard]] std::string controller_text(std::uint16_t id);

}  // namespace ivo::firmware::wheels
