#include "firmware/files/dbc_file.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "firmware/files/bus_description.hpp"

namespace ivo::firmware {
namespace {

/// Every number so that it reads back as itself.
std::string text(double value) {
  char digits[32];
  const auto [end, status] = std::to_chars(digits, digits + sizeof digits, value);
  return {digits, end};
}

std::string line(const BusMessage& message, const BusSignal& signal) {
  const double least = signal.is_signed ? -std::ldexp(1.0, signal.bits - 1) : 0.0;
  const double most = std::ldexp(1.0, signal.is_signed ? signal.bits - 1 : signal.bits) - 1;
  const double low = std::min(signal.factor * least, signal.factor * most);
  const double high = std::max(signal.factor * least, signal.factor * most);
  return " SG_ " + signal.name + (signal.mux.empty() ? "" : " " + signal.mux) + " : " + std::to_string(signal.start) +
         "|" + std::to_string(signal.bits) + "@1" + (signal.is_signed ? "-" : "+") + " (" + text(signal.factor) +
         ",0) [" + text(low) + "|" + text(high) + "] \"" + signal.unit + "\" " + message.receivers + "\n";
}

}  // namespace

std::string dbc_text(const Robot& robot) {
  const std::vector<BusMessage> messages = bus_messages(robot);
  std::string frames;
  std::string comments;
  std::string attributes;
  std::string values;
  for (const BusMessage& message : messages) {
    const std::string id = std::to_string(message.id);
    frames += "BO_ " + id + " " + message.name + ": " + std::to_string(message.bytes) + " " + message.sender + "\n";
    comments += "CM_ BO_ " + id + " \"" + message.comment + "\";\n";
    if (message.cycle > Duration::zero()) {
      attributes += "BA_ \"GenMsgCycleTime\" BO_ " + id + " " +
                    std::to_string(message.cycle / std::chrono::milliseconds(1)) + ";\n";
    }
    for (const BusSignal& signal : message.signals) {
      frames += line(message, signal);
      if (!signal.values.empty()) {
        values += "VAL_ " + id + " " + signal.name;
        for (const auto& [value, words] : signal.values) {
          values += " " + std::to_string(value) + " \"" + std::string(words) + "\"";
        }
        values += " ;\n";
      }
    }
    frames += "\n";
  }
  std::string nodes;
  for (const std::string& name : bus_nodes()) {
    nodes += " " + name;
  }
  return "VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_:" + nodes + "\n\n" + frames + comments +
         "\nBA_DEF_ \"BusType\" STRING ;\nBA_DEF_ \"Baudrate\" INT 10000 1000000;\n"
         "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n"
         "BA_DEF_DEF_ \"BusType\" \"CAN\";\nBA_DEF_DEF_ \"Baudrate\" 1000000;\nBA_DEF_DEF_ \"GenMsgCycleTime\" 0;\n"
         "BA_ \"BusType\" \"CAN\";\nBA_ \"Baudrate\" " +
         std::to_string(robot.bit_rate_bps) + ";\n" + attributes + "\n" + values;
}

}  // namespace ivo::firmware
