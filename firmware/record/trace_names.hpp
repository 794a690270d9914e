// What the numbers of trace events mean, for people.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "firmware/record/trace_event.hpp"

namespace ivo::firmware {

/// By number; a number without a name is shown as it is.
struct TraceNames {
  std::vector<std::string> phases;
  std::vector<std::string> slices;
  std::vector<std::string> modes;
  std::function<std::string(const TraceEvent& fault)> fault;
  std::vector<std::string> bus_states;
  std::vector<std::string> wheels;
  std::vector<std::string> agents;
  std::map<std::uint16_t, std::string> frames;  ///< by COB-ID

  [[nodiscard]] std::string of_fault(const TraceEvent& event) const {
    return fault ? fault(event) : "fault " + std::to_string(event.code);
  }
  [[nodiscard]] static std::string of(const std::vector<std::string>& names, std::size_t number) {
    return number < names.size() ? names[number] : std::to_string(number);
  }
};

}  // namespace ivo::firmware
