#include "firmware/tools/doctor/can_checks.hpp"

#include <algorithm>
#include <optional>

#include "drivers/canopen/bus_load.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

using hal::BusState;
using hal::InterfaceFacts;
using Outcome = hal::LinkAnswer::Outcome;

constexpr const char* kNotAsked = "no interface was named: --can can0";

/// How systemd-networkd sets it up (systemd.network(5)).
std::string network_file(const std::string& name, const std::string& setting) {
  return "[Match] Name=" + name + ", [CAN] " + setting + " in /etc/systemd/network/60-ivo-" + name + ".network";
}

/// How udev does (systemd.link(5)): the first file that matches counts, by its name, and 99-default.link matches all.
std::string link_file(const std::string& name, const std::string& setting) {
  return "[Match] OriginalName=" + name + ", [Link] " + setting + " in /etc/systemd/network/60-ivo-" + name + ".link";
}

Finding interface_there(const std::string& name, const hal::LinkAnswer& answer) {
  const std::string check = "interface";
  if (answer.outcome == Outcome::kNotTold) {
    return not_checked(check, name + ": the kernel gives no answer to RTM_GETLINK");
  }
  if (answer.outcome == Outcome::kMissing) {
    return fault(check, name + " is not there",
                 "`ip link show type can` lists those there are; of an adapter, `dmesg | grep -i can` and its driver");
  }
  if (!answer.facts.carries_can) {
    return fault(check, name + " carries no CAN", "`ip link show type can` lists those that do");
  }
  switch (answer.facts.kind) {
    case InterfaceFacts::Kind::kCan:
      return ok(check, name + ", a CAN controller");
    case InterfaceFacts::Kind::kVcan:
    case InterfaceFacts::Kind::kVxcan:
      return warning(check, name + " is virtual: no robot is on it",
                     "--can can0, or whatever `ip link show type can` lists");
    case InterfaceFacts::Kind::kOther:
      break;
  }
  return warning(check,
                 name + " carries CAN, but not through the kernel's CAN drivers: bit rate and state are not told",
                 "`ip -details link show " + name + "`");
}

Finding up(const InterfaceFacts& facts, std::uint32_t bit_rate_bps) {
  if (facts.up) {
    return ok("link", "up");
  }
  const bool set = facts.kind != InterfaceFacts::Kind::kCan || facts.bit_rate_bps == bit_rate_bps;
  return fault("link", "down",
               (set ? "`ip link set " + facts.name + " up`" : hal::command_for_bit_rate(facts.name, bit_rate_bps)) +
                   "; at each boot: " + network_file(facts.name, "BitRate=" + std::to_string(bit_rate_bps)));
}

Finding bit_rate(const InterfaceFacts& facts, std::uint32_t expected) {
  const std::string check = "bit rate";
  const std::string found = format("%g kbit/s", facts.bit_rate_bps / 1e3);
  if (facts.bit_rate_bps == expected) {
    return ok(check, found);
  }
  return fault(
      check, (facts.bit_rate_bps == 0 ? "not set" : found) + format("; expected the robot's %g kbit/s", expected / 1e3),
      hal::command_for_bit_rate(facts.name, expected));
}

Finding restart(const InterfaceFacts& facts) {
  const std::string check = "after bus-off";
  if (facts.restart_ms > 0) {
    return ok(check, format("restarts after %u ms", facts.restart_ms));
  }
  return warning(
      check, "stays off until somebody restarts it (restart-ms 0)",
      hal::command_for_restart(facts.name) + "; at each boot: " + network_file(facts.name, "RestartSec=100ms"));
}

Finding state(const InterfaceFacts& facts) {
  const std::string check = "controller state";
  if (!facts.controller) {
    return not_checked(check, facts.up ? "its driver tells no state" : "it is stopped while the link is down");
  }
  switch (*facts.controller) {
    case BusState::kActive:
      return ok(check, "error-active");
    case BusState::kWarning:
      return warning(check, "error-warning: frames were disturbed",
                     "termination (120 ohm at both ends), wiring, shield");
    case BusState::kOff:
      return fault(check, "bus-off: it sends nothing more",
                   "wiring and termination, then `ip link set " + facts.name + " type can restart`");
    default:
      return fault(check, "error-passive: nobody acknowledges, or two bit rates",
                   "are the drives powered, on this bus and at this bit rate? 60 ohm between CAN_H and CAN_L?");
  }
}

Finding counters(const InterfaceFacts& facts) {
  constexpr std::uint16_t kWarnAt = 96;  // as the controller does
  const std::string check = "error counters";
  if (!facts.counts_errors) {
    return not_checked(check, "its driver tells none");
  }
  const std::string found =
      format("transmit %u, receive %u", unsigned{facts.transmit_errors}, unsigned{facts.receive_errors});
  const std::uint16_t most = std::max(facts.transmit_errors, facts.receive_errors);
  if (most == 0) {
    return ok(check, found);
  }
  return warning(
      check,
      found + (most < kWarnAt ? ": frames were disturbed of late" : format("; expected less than %d", int{kWarnAt})),
      "termination (120 ohm at both ends), wiring, shield; `ip -details -statistics link show " + facts.name +
          "` counts on");
}

Finding queue(const InterfaceFacts& facts, const Robot& robot) {
  const std::string check = "queue length";
  const std::uint32_t least = frames_at_once(robot);
  const std::string found = format("%u frames", facts.queue_frames);
  const std::string remedy =
      hal::command_for_queue(facts.name) + "; at each boot: " + link_file(facts.name, "TransmitQueueLength=32");
  if (facts.queue_frames > hal::kLongestQueueFrames) {
    return warning(
        check, found + format(", which cannot be called back; expected at most %u", hal::kLongestQueueFrames), remedy);
  }
  if (facts.queue_frames < least) {
    return fault(check, found + format("; expected at least the %u that a cycle sends", least), remedy);
  }
  return ok(check, found + format(" (a cycle sends %u)", least));
}

/// A queue of 1000 on a virtual interface delays nothing, and it has no controller.
void check_hardware(const InterfaceFacts& facts, const Robot& robot, std::vector<Finding>& findings) {
  findings.push_back(bit_rate(facts, robot.bit_rate_bps));
  findings.push_back(queue(facts, robot));
  findings.push_back(restart(facts));
  findings.push_back(state(facts));
  findings.push_back(counters(facts));
}

}  // namespace

std::uint32_t frames_at_once(const Robot& robot) {
  const drivers::BusSchedule schedule = drivers::schedule_of(robot);
  const auto ours = std::ranges::count_if(schedule.span(), [](const drivers::PeriodicFrame& frame) {
    const drivers::FrameKind kind = drivers::kind_of(frame.id);
    return kind == drivers::FrameKind::kSync || kind == drivers::FrameKind::kRpdo;
  });
  return static_cast<std::uint32_t>(ours) + 1;
}

bool usable(const hal::LinkAnswer& answer, const Robot& robot) {
  return answer.outcome == Outcome::kFound && answer.facts.carries_can && answer.facts.up &&
         hal::check_bit_rate(answer.facts, robot.bit_rate_bps).ok();
}

Group can_checks(const std::string& interface, const hal::LinkAnswer& answer, const Robot& robot) {
  Group group{"CAN interface", {}};
  if (interface.empty()) {
    group.findings.push_back(not_checked("interface", kNotAsked));
    return group;
  }
  group.findings.push_back(interface_there(interface, answer));
  if (answer.outcome == Outcome::kFound && answer.facts.carries_can) {
    group.findings.push_back(up(answer.facts, robot.bit_rate_bps));
    if (answer.facts.kind == InterfaceFacts::Kind::kCan) {
      check_hardware(answer.facts, robot, group.findings);
    } else {
      group.findings.push_back(not_checked("bit rate, queue, state", "a virtual interface has none that matter"));
    }
  }
  return group;
}

}  // namespace ivo::firmware::doctor
