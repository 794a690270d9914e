#include "firmware/web/ros/ros_diagnostics.hpp"

#include <initializer_list>
#include <string_view>
#include <utility>

#include "firmware/files/number_text.hpp"
#include "firmware/web/ros/ros_outgoing.hpp"

namespace ivo::firmware::web {
namespace {

enum class Level : std::uint8_t { kOk, kWarning, kError, kStale };  // of diagnostic_msgs/DiagnosticStatus

using Values = std::initializer_list<std::pair<std::string_view, std::string>>;

struct DiagnosticWriter {
  ValueWriter& writer;
  const std::string& hardware;

  void add(std::string_view name, Level level, std::string_view message, Values values) const {
    writer.begin_object();
    writer.add("level", static_cast<int>(level)).add("name", "ivo: " + std::string(name));
    writer.add("message", message).add("hardware_id", hardware).begin_list("values");
    for (const auto& [key, value] : values) {
      writer.begin_object();
      writer.add("key", key).add("value", value).end_object();
    }
    writer.end_list();
    writer.end_object();
  }
};

Level controller_level(const View& view) {
  if (view.link != LinkState::kConnected) {
    return view.link == LinkState::kSilent ? Level::kWarning : Level::kStale;
  }
  return view.status && view.status->fault[0] != 0 ? Level::kError : Level::kOk;
}

std::string text_in(const std::array<char, 160>& text) {
  const std::string_view all(text.data(), text.size());
  return std::string(all.substr(0, all.find('\0')));
}

}  // namespace

void write_diagnostics(ValueWriter& writer, const View& view, const std::string& mission, const RosStamp& stamp) {
  writer.begin_object();
  write_header(writer, stamp, "");
  writer.begin_list("status");
  const DiagnosticWriter diagnostics{writer, mission};
  const Level controller = controller_level(view);
  const std::string fault = view.status ? text_in(view.status->fault) : "";
  diagnostics.add("controller", controller,
                  fault.empty() || controller == Level::kStale ? state_text(view) : std::string_view(fault),
                  {{"mode", std::string(state_text(view))}});
  if (view.status) {
    const console::Status& status = *view.status;
    const auto level = [&](bool bad) {
      return controller == Level::kStale ? controller : bad ? Level::kError : Level::kOk;
    };
    const bool drives_bad = status.fault_node_id != 0 || status.stop_held != 0;
    diagnostics.add(
        "drives", level(drives_bad),
        drives_bad ? (status.stop_held != 0 ? "a stop input is pressed" : "a drive is in fault") : "no fault",
        {{"fault_node_id", std::to_string(status.fault_node_id)},
         {"fault_code", std::to_string(status.fault_code)},
         {"stop_held", status.stop_held != 0 ? "true" : "false"},
         {"power_off", status.power_off != 0 ? "true" : "false"}});
    diagnostics.add("bus", level(status.bus_state != 0), status.bus_state != 0 ? "not error-active" : "error-active",
                    {{"frames_sent", std::to_string(status.frames_sent)},
                     {"frames_received", std::to_string(status.frames_received)},
                     {"send_dropped", std::to_string(status.send_dropped)},
                     {"receive_dropped", std::to_string(status.receive_dropped)},
                     {"malformed_frames", std::to_string(status.malformed_frames)}});
    diagnostics.add("loop", level(false), std::to_string(status.skipped) + " periods lost",
                    {{"cycles", std::to_string(status.cycles)},
                     {"skipped", std::to_string(status.skipped)},
                     {"refused_commands", std::to_string(status.refused_commands)},
                     {"refused_frames", std::to_string(status.refused_frames)}});
    diagnostics.add("planner", level(false), status.plan_ready != 0 ? "a plan is ready" : "no plan is ready",
                    {{"plan", std::to_string(status.plan_number)},
                     {"generation", std::to_string(status.generation)},
                     {"generations", std::to_string(status.generations)},
                     {"expected_time_s", shortest(status.expected_time_s)},
                     {"unseen_mass", shortest(status.unseen_mass)},
                     {"searched_mass", shortest(status.searched_mass)}});
  }
  writer.end_list();
  writer.end_object();
}

}  // namespace ivo::firmware::web
