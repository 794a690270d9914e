#include "firmware/console/console_status.hpp"

#include <algorithm>
#include <string>

#include "drivers/drive_fault_text.hpp"

namespace ivo::firmware::console {
namespace {

static_assert(limits::kAgents <= kAgents, "a status has room for every agent of a mission");

std::uint8_t as_byte(bool is) noexcept { return is ? 1 : 0; }

template <class Enumeration>
std::uint8_t number_of(Enumeration value) noexcept {
  return static_cast<std::uint8_t>(value);
}

void put(const std::string& text, Status& status) {
  std::size_t size = std::min(text.size(), status.fault.size() - 1);
  while (size < text.size() && size > 0 && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80U) {
    --size;  // no half of a character
  }
  std::copy_n(text.begin(), size, status.fault.begin());
}

}  // namespace

Status status_of(const LoopStatus& loop, int agents) {
  Status status;
  status.header.kind = Kind::kStatus;
  status.header.size = sizeof(Status);
  status.at_ns = loop.at.time_since_epoch().count();
  status.mode = number_of(loop.mode);
  status.search = number_of(loop.search);
  status.drives = number_of(loop.drives);
  status.stop_cause = number_of(loop.stop_cause);
  status.plan_ready = as_byte(loop.plan_ready);
  status.search_started = as_byte(loop.search_started);
  status.power_off = as_byte(loop.power_off);
  status.finished = as_byte(loop.finished);
  status.finder = loop.finder ? static_cast<std::uint8_t>(*loop.finder) : Status::kNobody;
  status.bus_state = number_of(loop.counters.bus_state);
  status.agents = static_cast<std::uint8_t>(agents);
  status.fault_reason = number_of(loop.drive_fault.reason);
  status.fault_node_id = loop.drive_fault.node_id;
  status.fault_wheel = number_of(loop.drive_fault.wheel);
  status.fault_turning_node_id = loop.drive_fault.turning_node_id;
  status.fault_code = loop.drive_fault.code;
  const bool held = loop.stop_held.reason != drivers::DriveFaultReason::kNone;
  status.stop_held = as_byte(held);
  if (loop.drive_fault.reason != drivers::DriveFaultReason::kNone) {
    put(drivers::describe(loop.drive_fault), status);
  } else if (held) {
    put(drivers::describe(loop.stop_held), status);
  }

  status.generation = loop.planning.generation;
  status.generations = loop.planning.generations;
  if (loop.planning.has_plan) {
    status.expected_time_s = loop.planning.best.expected_time_s;
    status.unseen_mass = loop.planning.best.unseen_mass;
    status.horizon_s = loop.planning.best.horizon_s;
  }
  status.search_time_ns = loop.search_time.count();
  status.heading_rad = loop.robot.heading_rad;
  status.plan_number = loop.plan_number;
  status.preparing = as_byte(loop.preparing);
  status.plan_followed = as_byte(loop.way_followed && loop.way_of_plan == loop.plan_number);
  status.pause_cause = number_of(loop.pause_cause);
  status.watched = as_byte(loop.watched);
  status.beat_age_s = loop.beat_age ? seconds(*loop.beat_age) : -1.0;
  for (std::size_t i = 0; i < std::min(loop.tracks.size(), static_cast<std::size_t>(agents)); ++i) {
    const AgentTrack& track = loop.tracks[i];
    const std::optional<Duration>& age = loop.report_age[i];
    status.agent[i] = {.x_m = track.position.x_m,
                       .y_m = track.position.y_m,
                       .moved_m = track.moved_m,
                       .left_m = i == 0 ? loop.distance_left_m : 0.0,
                       .path_ended = as_byte(track.path_ended),
                       .reported = as_byte(age.has_value()),
                       .report_age_s = age ? seconds(*age) : -1.0};
  }

  const LoopCounters& counters = loop.counters;
  status.cycles = counters.cycles;
  status.skipped = counters.skipped;
  status.refused_commands = counters.refused_commands;
  status.refused_frames = counters.refused_frames;
  status.malformed_frames = counters.malformed_frames;
  status.frames_sent = counters.bus.sent;
  status.frames_received = counters.bus.received;
  status.send_dropped = counters.bus.send_dropped;
  status.receive_dropped = counters.bus.receive_dropped;
  return status;
}

}  // namespace ivo::firmware::console
