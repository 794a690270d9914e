#include "firmware/tools/wheels/turn_text.hpp"

#include <cmath>
#include <numbers>

#include "drivers/canopen/emcy_text.hpp"
#include "drivers/drive_fault_text.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/state_words.hpp"

namespace ivo::firmware::wheels {
namespace {

std::string way_text(const TurnMeasure::Result& turned) {
  return format("%.2f turns, %lld counts", turned.rad / (2.0 * std::numbers::pi),
                static_cast<long long>(turned.counts));
}

std::string waiting_text(const TurnStatus& status, const char* power) {
  if (status.key == DeadMan::State::kForbidden) {
    return "let go of the space bar";
  }
  if (status.key != DeadMan::State::kReleased) {
    return std::string(power) + "; keep holding";
  }
  return std::string(power) + "; hold the space bar to turn it, any other key ends";
}

}  // namespace

std::string wheel_text(const Robot& robot, Wheel wheel) {
  return std::string(name_of(wheel)) + format(" (node %d)", int{robot.drives[static_cast<std::size_t>(wheel)].node_id});
}

std::string status_text(const TurnStatus& status) {
  const TurnMeasure::Result& turned = status.turned;
  switch (status.phase) {
    case TurnPhase::kStarting:
      return format("the drives start up (%.1f s)", seconds(status.at.time_since_epoch()));
    case TurnPhase::kOff:
      return waiting_text(status, "power off");
    case TurnPhase::kPowering:
      return "power comes up; keep holding";
    case TurnPhase::kWaiting:
      return waiting_text(status, "power on");
    case TurnPhase::kTurning:
      return format("turns: told %+.2f rad/s, turns %+.2f; ", turned.told_radps, turned.radps) + way_text(turned);
    case TurnPhase::kSlowing:
      return format("stops: told %+.2f rad/s, turns %+.2f; ", turned.told_radps, turned.radps) + way_text(turned);
    case TurnPhase::kEnding:
      return "stops; power goes off";
    case TurnPhase::kEnded:
      break;
  }
  return "power off";
}

std::string note_text(const TurnMeasure::Result& turned, Wheel wheel) {
  const std::string name(name_of(wheel));
  switch (turned.note) {
    case TurnNote::kNone:
      break;
    case TurnNote::kTooFast:
      return name + format(
                        " was stopped: by its position it went %.2g times as far as told; velocity_per_radps too "
                        "high, or counts_per_turn too low?",
                        std::abs(turned.rad / turned.told_rad));
    case TurnNote::kStays:
      return name +
             " was stopped: it was told to turn, but its position hardly changes; wheel blocked, motor or encoder "
             "not connected, or velocity_per_radps far too low?";
    case TurnNote::kAgainst:
      return name +
             " was stopped: its position counts against its velocity; polarity of the encoder, or 607Eh of the "
             "drive?";
    case TurnNote::kOtherMoves:
      return name + " was stopped: the position of " + std::string(name_of(turned.note_wheel)) +
             " changed; encoders exchanged, or was it turned by hand?";
  }
  return {};
}

std::string measured_text(const TurnMeasure::Result& turned) {
  std::string text = way_text(turned);
  if (turned.steady > Duration::zero()) {
    text += format("; told %+.3f rad/s, turned %+.3f (%+.1f %%)", turned.steady_told_radps, turned.steady_radps,
                   100.0 * (turned.steady_radps / turned.steady_told_radps - 1.0));
  }
  return text;
}

std::string fault_text(const drivers::DriveFault& fault) {
  std::string text = drivers::describe(fault);
  if (fault.reason == drivers::DriveFaultReason::kEmergency && fault.code != 0) {
    text += ": " + std::string(drivers::emergency_class(static_cast<std::uint16_t>(fault.code)));
  }
  return text;
}

}  // namespace ivo::firmware::wheels
