#include "firmware/files/bus_description.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <numbers>

#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"

namespace ivo::firmware {
namespace {

namespace cob_id = drivers::cob_id;

constexpr std::string_view kController = "Controller";
constexpr std::array<std::string_view, kWheels> kDriveNames = {"FrontLeft", "FrontRight", "RearLeft", "RearRight"};

// CiA 402-2, 6.1 and 6.2. Bits that a profile leaves to the mode or the maker are named by their number.
const std::array<std::pair<std::string_view, SignalValues>, 16> kStatusBits = {{
    {"ReadyToSwitchOn", {}},
    {"SwitchedOn", {}},
    {"OperationEnabled", {}},
    {"Fault", {{0, "no fault"}, {1, "fault"}}},
    {"VoltageEnabled", {}},
    {"QuickStop", {{0, "quick stop is active"}, {1, "no quick stop"}}},
    {"SwitchOnDisabled", {}},
    {"Warning", {}},
    {"Bit8", {}},
    {"Remote", {{0, "controlword is not looked at"}, {1, "controlword is obeyed"}}},
    {"TargetReached", {}},
    {"InternalLimit", {}},
    {"Bit12", {}},
    {"Bit13", {}},
    {"Bit14", {}},
    {"Bit15", {}},
}};
const std::array<std::pair<std::string_view, SignalValues>, 16> kControlBits = {{
    {"SwitchOn", {}},
    {"EnableVoltage", {}},
    {"QuickStop", {{0, "quick stop is asked for"}, {1, "no quick stop"}}},
    {"EnableOperation", {}},
    {"Bit4", {}},
    {"Bit5", {}},
    {"Bit6", {}},
    {"FaultReset", {{0, "none"}, {1, "reset, when it was 0 before"}}},
    {"Halt", {}},
    {"Bit9", {}},
    {"Bit10", {}},
    {"Bit11", {}},
    {"Bit12", {}},
    {"Bit13", {}},
    {"Bit14", {}},
    {"Bit15", {}},
}};
const SignalValues kNmtCommands = {
    {1, "start"}, {2, "stop"}, {128, "enter pre-operational"}, {129, "reset node"}, {130, "reset communication"}};
const SignalValues kNmtStates = {{0, "boot-up"}, {4, "stopped"}, {5, "operational"}, {127, "pre-operational"}};
const SignalValues kErrorCodes = {{0x0000, "errors are gone"},        {0x8110, "CAN overrun"},
                                  {0x8120, "CAN error passive"},      {0x8130, "heartbeat or life guard lost"},
                                  {0x8140, "recovered from bus-off"}, {0x8210, "PDO too short"},
                                  {0x8220, "PDO too long"},           {0x8250, "RPDO time-out"}};
const SignalValues kSdoRequests = {
    {0, "download segment"}, {1, "download"}, {2, "upload"}, {3, "upload segment"}, {4, "abort"}};
const SignalValues kSdoAnswers = {
    {0, "upload segment"}, {1, "download segment"}, {2, "upload"}, {3, "download"}, {4, "abort"}};

void add_bits(std::vector<BusSignal>& signals, const std::array<std::pair<std::string_view, SignalValues>, 16>& bits) {
  for (int bit = 0; bit < 16; ++bit) {
    const auto& [name, values] = bits[static_cast<std::size_t>(bit)];
    signals.push_back({.name = std::string(name), .start = bit, .bits = 1, .values = values});
  }
}

BusSignal target(const DriveParameters& drive, std::string name, int start) {
  return {.name = std::move(name),
          .start = start,
          .bits = 32,
          .is_signed = true,
          .factor = drive.sign / (drive.gear_ratio * drive.velocity_per_radps),
          .unit = "rad/s"};
}

/// A service's bits and bytes stand where another's do; the upper three bits of byte 0 say which it is (CiA 301,
/// 7.2.4.3). Addresses have a name a service: not every tool knows a signal of several multiplexer values.
std::vector<BusSignal> sdo_signals(bool request) {
  std::vector<BusSignal> signals = {
      {.name = "Service", .start = 5, .bits = 3, .values = request ? kSdoRequests : kSdoAnswers, .mux = "M"},
      {.name = "LastSegment", .start = 0, .bits = 1, .mux = "m0"},
      {.name = "SegmentBytesUnused", .start = 1, .bits = 3, .mux = "m0"},
      {.name = "SegmentToggle", .start = 4, .bits = 1, .mux = "m0"},
      {.name = "SegmentData", .start = 8, .bits = 56, .mux = "m0"},
      {.name = "OtherEndsToggle", .start = 4, .bits = 1, .mux = request ? "m3" : "m1"},
      {.name = "AbortCode", .start = 32, .bits = 32, .mux = "m4"}};
  const auto addressed = [&](const std::string& what, const std::string& mux) {
    signals.push_back({.name = what + "Index", .start = 8, .bits = 16, .mux = mux});
    signals.push_back({.name = what + "SubIndex", .start = 24, .bits = 8, .mux = mux});
  };
  addressed("Download", request ? "m1" : "m3");
  addressed("Upload", "m2");
  addressed("Abort", "m4");
  const std::string with_data = request ? "m1" : "m2";
  signals.push_back({.name = "SizeGiven", .start = 0, .bits = 1, .mux = with_data});
  signals.push_back({.name = "Expedited", .start = 1, .bits = 1, .mux = with_data});
  signals.push_back({.name = "DataBytesUnused", .start = 2, .bits = 2, .mux = with_data});
  signals.push_back({.name = "Data", .start = 32, .bits = 32, .mux = with_data});
  return signals;
}

}  // namespace

std::vector<std::string> bus_nodes() {
  std::vector<std::string> nodes = {std::string(kController)};
  nodes.insert(nodes.end(), kDriveNames.begin(), kDriveNames.end());
  return nodes;
}

std::vector<BusMessage> bus_messages(const Robot& robot) {
  std::string drives;
  for (const std::string_view name : kDriveNames) {
    drives += (drives.empty() ? "" : ",") + std::string(name);
  }
  const std::string controller(kController);
  std::vector<BusMessage> messages = {
      {.id = cob_id::kNmt,
       .name = "NMT",
       .bytes = 2,
       .sender = controller,
       .receivers = drives,
       .signals = {{.name = "Command", .start = 0, .bits = 8, .values = kNmtCommands},
                   {.name = "NodeId", .start = 8, .bits = 8, .values = {{0, "all nodes"}}}},
       .comment = "CiA 301, 7.2.8: what a node, or all, are to do"},
      {.id = cob_id::kSync,
       .name = "SYNC",
       .bytes = 0,
       .sender = controller,
       .receivers = drives,
       .comment = "CiA 301, 7.2.5: drives sample their feedback and act on the commands received before",
       .cycle = robot.cycle}};
  const auto heartbeat = [&](const std::string& name, std::uint8_t node, const std::string& receivers, Duration every) {
    messages.push_back({.id = cob_id::heartbeat(node),
                        .name = "Heartbeat_" + name,
                        .bytes = 1,
                        .sender = name,
                        .receivers = receivers,
                        .signals = {{.name = "NmtState", .start = 0, .bits = 7, .values = kNmtStates},
                                    {.name = "Toggle", .start = 7, .bits = 1}},
                        .comment = "CiA 301, 7.2.8.3.2: boot-up message and heartbeat",
                        .cycle = every});
  };
  for (std::size_t i = 0; i < kDriveNames.size(); ++i) {
    const DriveParameters& drive = robot.drives[i];
    const std::uint8_t node = drive.node_id;
    const std::string name(kDriveNames[i]);
    messages.push_back({.id = cob_id::emcy(node),
                        .name = "EMCY_" + name,
                        .bytes = 8,
                        .sender = name,
                        .receivers = controller,
                        .signals = {{.name = "ErrorCode", .start = 0, .bits = 16, .values = kErrorCodes},
                                    {.name = "ErrorRegister", .start = 16, .bits = 8},
                                    {.name = "MakersBytes", .start = 24, .bits = 40}},
                        .comment = "CiA 301, 7.2.7: sent once for each error, and when errors are gone"});

    BusMessage status{.id = cob_id::tpdo1(node),
                      .name = "TPDO1_" + name,
                      .bytes = 6,
                      .sender = name,
                      .receivers = controller,
                      .comment = "Statusword 6041h and position 6064h, sampled at SYNC",
                      .cycle = robot.cycle};
    add_bits(status.signals, kStatusBits);
    const double turn = 2 * std::numbers::pi;
    status.signals.push_back({.name = "WheelAngle",
                              .start = 16,
                              .bits = 32,
                              .is_signed = true,
                              .factor = drive.sign * turn / (drive.counts_per_turn * drive.gear_ratio),
                              .unit = "rad"});
    messages.push_back(std::move(status));

    const bool own = robot.pdo_layout == PdoLayout::kOwn;
    BusMessage command{.id = cob_id::rpdo1(node),
                       .name = "RPDO1_" + name,
                       .bytes = own ? 6 : 2,
                       .sender = controller,
                       .receivers = name,
                       .comment = own ? "Controlword 6040h and target velocity 60FFh, acted on at the next SYNC"
                                      : "Controlword 6040h, when it changes and every now and then",
                       .cycle = own ? robot.cycle : rates::kControlwordRefresh};
    add_bits(command.signals, kControlBits);
    if (own) {
      command.signals.push_back(target(drive, "TargetWheelSpeed", 16));
    }
    messages.push_back(std::move(command));

    for (const bool request : {true, false}) {
      messages.push_back({.id = request ? cob_id::sdo_request(node) : cob_id::sdo_answer(node),
                          .name = (request ? "SDO_Request_" : "SDO_Answer_") + name,
                          .bytes = 8,
                          .sender = request ? controller : name,
                          .receivers = request ? name : controller,
                          .signals = sdo_signals(request),
                          .comment = "CiA 301, 7.2.4: access to one object of the drive's dictionary"});
    }
    heartbeat(name, node, controller, rates::kDriveHeartbeat);
  }
  for (std::size_t first = 0; robot.pdo_layout == PdoLayout::kShared && first < kDriveNames.size(); first += 2) {
    const std::array<std::string, 2> pair = {std::string(kDriveNames[first]), std::string(kDriveNames[first + 1])};
    messages.push_back({.id = cob_id::of(0x300, robot.drives[first].node_id),
                        .name = "RPDO2_" + pair[0] + "_" + pair[1],
                        .bytes = 8,
                        .sender = controller,
                        .receivers = pair[0] + "," + pair[1],
                        .signals = {target(robot.drives[first], "TargetWheelSpeed_" + pair[0], 0),
                                    target(robot.drives[first + 1], "TargetWheelSpeed_" + pair[1], 32)},
                        .comment = "Target velocities 60FFh of two drives, acted on at the next SYNC",
                        .cycle = robot.cycle});
  }
  heartbeat(controller, robot.master_node_id, drives, rates::kMasterHeartbeat);
  std::sort(messages.begin(), messages.end(), [](const BusMessage& a, const BusMessage& b) { return a.id < b.id; });
  return messages;
}

}  // namespace ivo::firmware
