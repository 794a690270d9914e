// Every frame on a robot's bus and every quantity in it, in names and units for people and their tools.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::firmware {

/// Words for some of a signal's values.
using SignalValues = std::vector<std::pair<int, std::string_view>>;

struct BusSignal {
  std::string name;
  int start = 0;  // bit, little endian
  int bits = 0;
  bool is_signed = false;
  double factor = 1.0;
  std::string unit{};
  SignalValues values{};
  std::string mux{};  // "M", "m3", or empty
};

struct BusMessage {
  std::uint16_t id = 0;
  std::string name;
  int bytes = 0;
  std::string sender;
  std::string receivers;  // of its signals
  std::vector<BusSignal> signals{};
  std::string comment{};
  Duration cycle{};  // zero: as it happens
};

/// Nodes by name: the controller, then the drives by Wheel.
[[nodiscard]] std::vector<std::string> bus_nodes();

/// By COB-ID: NMT, SYNC, the controller's heartbeat, and of each drive EMCY, PDOs in the robot's layout, SDO both ways
/// and heartbeat. Wheel angles and speeds are those of the wheel, after gear and sign.
[[nodiscard]] std::vector<BusMessage> bus_messages(const Robot& robot);

}  // namespace ivo::firmware
