#include "firmware/files/robot_inputs.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace ivo::firmware {
namespace {

constexpr std::int64_t kLastLine = 1023;

/// Reads lines and remembers whose they are.
class LineReader {
 public:
  InputLine read(const TomlValue& table, const std::string& name) {
    InputLine input;
    const TomlValue line = table.required("line");
    input.line = static_cast<unsigned>(line.integer(0, kLastLine));
    input.active_low = table.required("active_low").flag();
    const auto [owner, fresh] = owners_.emplace(input.line, name);
    if (line.present() && !fresh) {
      line.complain(std::to_string(input.line) + " is already " + owner->second + "'s; expected a line of its own");
    }
    return input;
  }

 private:
  std::map<unsigned, std::string> owners_;
};

}  // namespace

InputParameters read_inputs(const TomlValue& table) {
  InputParameters inputs;
  if (!table.present()) {
    return inputs;
  }
  inputs.chip = table.required("chip").text();
  LineReader lines;
  const TomlValue stop = table.optional("emergency_stop");
  if (stop.present()) {
    inputs.emergency_stop = lines.read(stop, "inputs.emergency_stop");
  }
  const TomlValue list = table.optional("bumpers");
  const std::vector<TomlValue> bumpers = list.items(1, kBumpers, "bumpers");
  for (std::size_t i = 0; i < bumpers.size(); ++i) {
    inputs.bumpers[i] = lines.read(bumpers[i], "inputs.bumpers[" + std::to_string(i) + "]");
  }
  if (!stop.present() && !list.present()) {
    table.complain("has no input; expected emergency_stop, bumpers or both, or no such table");
  }
  return inputs;
}

}  // namespace ivo::firmware
