#include "firmware/tools/trace/trace_words.hpp"

#include <string_view>

#include "drivers/drive_fault_text.hpp"
#include "firmware/files/bus_description.hpp"
#include "firmware/files/wheel_keys.hpp"
#include "firmware/loop/phase.hpp"
#include "firmware/safety/mode.hpp"
#include "hal/api/can_bus.hpp"
#include "planner/search/slice_kind.hpp"

namespace ivo::firmware {
namespace {

template <class Kind>
std::vector<std::string> words(int count) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    names.emplace_back(name_of(static_cast<Kind>(i)));
  }
  return names;
}

std::string fault_words(const TraceEvent& event) {
  const TracedFault fault = event.get<TracedFault>();
  drivers::DriveFault described;
  described.reason = static_cast<drivers::DriveFaultReason>(event.code);
  described.node_id = static_cast<std::uint8_t>(fault.node_id);
  described.wheel = static_cast<Wheel>(event.id);
  described.code = static_cast<std::uint32_t>(fault.code);
  return drivers::describe(described);
}

}  // namespace

TraceNames trace_words(const Robot& robot, const Mission& mission) {
  TraceNames names;
  names.phases = words<Phase>(static_cast<int>(kPhases));
  names.slices = words<planner::SliceKind>(planner::kSliceKinds);
  names.modes = words<Mode>(kModes);
  names.bus_states = words<hal::BusState>(hal::kBusStates);
  names.wheels.assign(kWheelKeys.begin(), kWheelKeys.end());
  names.fault = fault_words;
  for (const AgentSpec& agent : mission.agents) {
    names.agents.push_back(agent.name);
  }
  for (const BusMessage& message : bus_messages(robot)) {
    names.frames[message.id] = message.name;
  }
  return names;
}

}  // namespace ivo::firmware
