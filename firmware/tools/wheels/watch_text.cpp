#include "firmware/tools/wheels/watch_text.hpp"

#include <cmath>
#include <numbers>

#include "config/rates.hpp"
#include "drivers/canopen/emcy_text.hpp"
#include "drivers/cia402/statusword.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/state_words.hpp"

namespace ivo::firmware::wheels {
namespace {

constexpr Duration kLate = 2 * rates::kDriveHeartbeatTimeout;  // of a heartbeat; drives may be set to a slower one

std::string age_text(Instant then, Instant now) {
  const double age_s = seconds(now - then);
  return age_s < 1.0 ? format("%.0f ms", age_s * 1000.0) : format("%.1f s", age_s);
}

std::string heartbeat_text(const HeardNode& node, Instant now) {
  return node.state ? age_text(node.heartbeat_at, now) : "none";
}

std::string emergency_text(const HeardNode& node, Instant now) {
  if (!node.emergency) {
    return "none";
  }
  return error_code_text(node.emergency->code) + format(" (%s ago)", age_text(node.emergency_at, now).c_str());
}

std::string bus_line(const BusListener& heard, const BusView& bus, Instant now) {
  const BusTraffic& traffic = heard.traffic();
  std::string line =
      std::string(name_of(bus.state)) +
      format("; load %.1f %%, %.0f frames/s, SYNC %.0f/s; controller %s", 100.0 * traffic.load, traffic.frames_per_s,
             traffic.syncs_per_s,
             heard.controller_at() ? ("heard " + age_text(*heard.controller_at(), now) + " ago").c_str() : "not heard");
  if (bus.counters.receive_dropped > 0) {
    line += format("; %llu frames lost", static_cast<unsigned long long>(bus.counters.receive_dropped));
  }
  return line;
}

std::string wheel_line(const BusListener& heard, const Robot& robot, Wheel wheel, Instant now) {
  const HeardNode& node = heard.node(wheel);
  std::string power = "-";
  std::string word = "-";
  std::string motion = format("%9s %7s %7s", "-", "-", "-");
  if (node.status) {  // + 0.0: of the two zeros the one without a sign
    power = name_of(drivers::cia402::power_state(node.status->statusword));
    word = hexadecimal(node.status->statusword, 4);
    const std::string told = node.told_radps ? format("%+.2f", *node.told_radps + 0.0) : "-";
    motion = format("%+9.3f %7s %+7.2f", heard.angle_rad(wheel) / (2.0 * std::numbers::pi) + 0.0, told.c_str(),
                    heard.radps(wheel, now));
  }
  return format("%-11s  %4d  %-15s  %-22s  %-5s  %s  %9s  %s", std::string(name_of(wheel)).c_str(),
                int{robot.drives[static_cast<std::size_t>(wheel)].node_id},
                node.state ? name_of(*node.state).c_str() : "-", power.c_str(), word.c_str(), motion.c_str(),
                heartbeat_text(node, now).c_str(), emergency_text(node, now).c_str());
}

}  // namespace

std::vector<std::string> watch_picture(const BusListener& heard, const Robot& robot, const BusView& bus, Instant now) {
  std::vector<std::string> lines{bus_line(heard, bus, now), "",
                                 format("%-11s  %4s  %-15s  %-22s  %-5s  %9s %7s %7s  %9s  %s", "wheel", "node", "NMT",
                                        "power", "6041h", "turns", "told", "rad/s", "heartbeat", "last emergency")};
  for (int wheel = 0; wheel < kWheels; ++wheel) {
    lines.push_back(wheel_line(heard, robot, static_cast<Wheel>(wheel), now));
  }
  return lines;
}

void ChangeLog::update(const BusListener& heard, const BusView& bus, Instant now) {
  if (bus_ != bus.state) {
    bus_ = bus.state;
    say_("bus: " + std::string(name_of(bus.state)));
  }
  if (bus.counters.receive_dropped != lost_) {
    say_(format("bus: %llu frames lost", static_cast<unsigned long long>(bus.counters.receive_dropped - lost_)));
    lost_ = bus.counters.receive_dropped;
  }
  const bool controller =
      heard.controller_at().has_value() && now - *heard.controller_at() <= rates::kMasterHeartbeatTimeout;
  if (controller != controller_) {
    controller_ = controller;
    say_(controller ? "controller: its heartbeat is heard" : "controller: heartbeat lost");
  }
  for (int wheel = 0; wheel < kWheels; ++wheel) {
    update_wheel(static_cast<Wheel>(wheel), heard.node(static_cast<Wheel>(wheel)), now);
  }
}

void ChangeLog::update_wheel(Wheel wheel, const HeardNode& node, Instant now) {
  Said& said = said_[static_cast<std::size_t>(wheel)];
  const std::string name = std::string(name_of(wheel)) + ": ";
  if (node.boot_ups != said.boot_ups) {
    said.boot_ups = node.boot_ups;
    said.power.reset();
    say_(name + "booted");
  }
  if (node.state && node.state != said.state && node.state != drivers::NmtState::kBootUp) {
    say_(name + "NMT " + name_of(*node.state));
  }
  said.state = node.state;
  // A node that has just booted sends no heartbeat before it is told to.
  const bool speaks = node.state && *node.state != drivers::NmtState::kBootUp;
  const bool lost = speaks && now - node.heartbeat_at > kLate;
  if (lost != said.heartbeat_lost) {
    said.heartbeat_lost = lost;
    say_(name + (lost ? "heartbeat lost" : "heartbeat back"));
  }
  if (node.status) {
    const auto power = drivers::cia402::power_state(node.status->statusword);
    if (power != said.power) {
      said.power = power;
      say_(name + std::string(name_of(power)) + " (statusword " + hexadecimal(node.status->statusword, 4) + ")");
    }
  }
  if (node.emergencies != said.emergencies) {
    said.emergencies = node.emergencies;
    say_(name + drivers::describe(drivers::EmcyEntry{.emergency = *node.emergency, .count = 1}));
  }
}

}  // namespace ivo::firmware::wheels
