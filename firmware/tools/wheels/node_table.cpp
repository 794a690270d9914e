#include "firmware/tools/wheels/node_table.hpp"

#include <algorithm>
#include <array>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/cia402/mode.hpp"
#include "drivers/cia402/objects.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/state_words.hpp"

namespace ivo::firmware::wheels {
namespace {

using drivers::cia402::PowerState;

constexpr std::array<const char*, 11> kHeading{"node",     "wheel",  "NMT",   "profile", "vendor", "product",
                                               "revision", "serial", "modes", "power",   "name"};
using Row = std::array<std::string, kHeading.size()>;

std::string drive_text(const Robot& robot, Wheel wheel) {
  return "node " + std::to_string(robot.drives[static_cast<std::size_t>(wheel)].node_id) + " (" +
         std::string(name_of(wheel)) + ")";
}

std::string hexadecimal_or_dash(const std::optional<std::uint32_t>& value) {
  return value ? hexadecimal(*value, 8) : "-";
}

std::string state_text(const ScannedNode& node) {
  if (node.state) {
    return name_of(*node.state);
  }
  return node.booted ? "booted" : "no heartbeat";
}

std::string power_text(const ScannedNode& node) {
  const auto& word = node.value(ScanObject::kStatusword);
  return word ? std::string(name_of(drivers::cia402::power_state(static_cast<std::uint16_t>(*word)))) : "-";
}

// What a node sends goes to a terminal: nothing but what can be seen may.
std::string name_text(const ScannedNode& node) {
  std::string text(node.name ? node.name->view() : std::string_view());
  std::ranges::replace_if(
      text, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return text.empty() ? "-" : text;
}

Row row_of(const Robot& robot, std::uint8_t id, const ScannedNode& node) {
  const auto wheel = wheel_of(robot, id);
  const auto& type = node.value(ScanObject::kDeviceType);
  const auto& modes = node.value(ScanObject::kModes);
  return {std::to_string(id),
          wheel ? std::string(name_of(*wheel)) : "-",
          state_text(node),
          type ? std::to_string(*type & 0xFFFF) : "-",
          hexadecimal_or_dash(node.value(ScanObject::kVendor)),
          hexadecimal_or_dash(node.value(ScanObject::kProduct)),
          hexadecimal_or_dash(node.value(ScanObject::kRevision)),
          hexadecimal_or_dash(node.value(ScanObject::kSerial)),
          modes ? modes_text(*modes) : "-",
          power_text(node),
          name_text(node)};
}

// Columns as wide as their widest text; the first flush right, for it is a number.
std::vector<std::string> aligned(const std::vector<Row>& rows) {
  std::array<int, kHeading.size()> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], static_cast<int>(row[i].size()));
    }
  }
  std::vector<std::string> lines;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += format(i == 0 ? "%*s" : "  %-*s", widths[i], row[i].c_str());
    }
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
  return lines;
}

class Judge {
 public:
  Judge(NodeTable& table, const NodeScan& scan, const Robot& robot) : table_(table), scan_(scan), robot_(robot) {}

  void wheel(Wheel wheel) {
    const DriveParameters& drive = robot_.drives[static_cast<std::size_t>(wheel)];
    const ScannedNode& node = scan_.node(drive.node_id);
    if (!node.there()) {
      wrong("missing", drive_text(robot_, wheel) +
                           (scan_.controller() ? ": nothing heard of it"
                                               : ": no answer; is it powered, on this bus and set to this node-id?"));
      return;
    }
    if (!node.answered) {
      if (!scan_.controller()) {
        wrong("note", drive_text(robot_, wheel) + ": speaks, but answers no SDO request");
      }
      return;
    }
    const auto& type = node.value(ScanObject::kDeviceType);
    if (type && (*type & 0xFFFF) != drivers::cia402::kProfileNumber) {
      wrong("differs", drive_text(robot_, wheel) + ": device profile " + std::to_string(*type & 0xFFFF) +
                           ", expected 402, a drive");
    }
    identity(wheel, "vendor", node.value(ScanObject::kVendor), drive.vendor_id);
    identity(wheel, "product", node.value(ScanObject::kProduct), drive.product_code);
    const auto& modes = node.value(ScanObject::kModes);
    if (modes && !drivers::cia402::velocity_mode(*modes)) {
      wrong("differs", drive_text(robot_, wheel) + ": offers " + modes_text(*modes) + ", expected CSV or PV");
    }
    if (const auto fault = fault_text(scan_, robot_, wheel)) {
      wrong("fault", *fault);
    }
  }

  void stranger(std::uint8_t id) {
    if (scan_.node(id).there() && !wheel_of(robot_, id) && id != robot_.master_node_id) {
      table_.remarks.push_back({"unknown", "node " + std::to_string(id) + ": no wheel of the robot file has it"});
    }
  }

 private:
  void identity(Wheel wheel, const char* what, const std::optional<std::uint32_t>& says, std::uint32_t expected) {
    if (says && expected != 0 && *says != expected) {
      wrong("differs", drive_text(robot_, wheel) + ": " + what + " " + hexadecimal(*says, 8) +
                           ", the robot file expects " + hexadecimal(expected, 8));
    }
  }
  void wrong(const char* label, const std::string& text) {
    table_.remarks.push_back({label, text});
    table_.as_expected = false;
  }

  NodeTable& table_;
  const NodeScan& scan_;
  const Robot& robot_;
};

}  // namespace

NodeTable node_table(const NodeScan& scan, const Robot& robot) {
  NodeTable table;
  std::vector<Row> rows;
  Row heading;
  std::ranges::copy(kHeading, heading.begin());
  rows.push_back(heading);
  for (std::uint8_t id = 1; id <= NodeScan::kNodes; ++id) {
    if (scan.node(id).there()) {
      rows.push_back(row_of(robot, id, scan.node(id)));
      ++table.nodes;
    }
  }
  if (table.nodes > 0) {
    table.rows = aligned(rows);
  }
  Judge judge(table, scan, robot);
  for (int wheel = 0; wheel < kWheels; ++wheel) {
    judge.wheel(static_cast<Wheel>(wheel));
  }
  for (std::uint8_t id = 1; id <= NodeScan::kNodes; ++id) {
    judge.stranger(id);
  }
  return table;
}

std::optional<std::string> fault_text(const NodeScan& scan, const Robot& robot, Wheel wheel) {
  const ScannedNode& node = scan.node(robot.drives[static_cast<std::size_t>(wheel)].node_id);
  const auto& word = node.value(ScanObject::kStatusword);
  if (!word) {
    return std::nullopt;
  }
  const PowerState state = drivers::cia402::power_state(static_cast<std::uint16_t>(*word));
  if (state != PowerState::kFault && state != PowerState::kFaultReactionActive) {
    return std::nullopt;
  }
  const auto& code = node.value(ScanObject::kErrorCode);
  return drive_text(robot, wheel) + ": in fault (statusword " + hexadecimal(*word, 4) + ")" +
         (code && *code != 0 ? ", error " + error_code_text(static_cast<std::uint16_t>(*code)) : "");
}

std::string controller_text(std::uint16_t id) {
  if (id == drivers::cob_id::kNmt) {
    return "an NMT order";
  }
  if (id == drivers::cob_id::kSync) {
    return "SYNC";
  }
  const std::string node = "node " + std::to_string(drivers::cob_id::node_of(id));
  if ((id & 0x780) == drivers::cob_id::heartbeat(0)) {
    return "a heartbeat of " + node;
  }
  return ((id & 0x780) == drivers::cob_id::rpdo1(0) ? "an RPDO to " : "an SDO request to ") + node;
}

}  // namespace ivo::firmware::wheels
