#include <cmath>
#include <numbers>

#include "firmware/files/number_text.hpp"
#include "firmware/tools/wheels/state_words.hpp"
#include "firmware/tools/wheels/turn_session.hpp"
#include "firmware/tools/wheels/turn_text.hpp"

namespace ivo::firmware::wheels {
namespace {

constexpr double kSlowestRadps = 0.01;

}  // namespace

int turn(const Options& options) {
  const std::optional<Wheel> wheel = wheel_called(options.wheel);
  if (!wheel) {
    return refuse(
        {"no wheel is called \"" + options.wheel + "\"; expected front_left, front_right, rear_left or rear_right"});
  }
  const double radps = options.radps.value_or(kUsualRadps);
  if (std::abs(radps) < kSlowestRadps) {
    return refuse({"--radps: " + shortest(radps) + "; expected other than 0, as 0.5 or -0.5"});
  }
  int status = 0;
  const std::unique_ptr<TurnSession> session = TurnSession::begin(options, "turn", status);
  if (session == nullptr) {
    return status;
  }
  TurnLoop& loop = session->loop();
  const Robot& robot = session->world().robot();
  say("turn", wheel_text(robot, *wheel) +
                  format(" at %.2f rad/s, a turn in %.0f s", radps, 2.0 * std::numbers::pi / std::abs(radps)));
  loop.give({.wheel = *wheel, .radps = radps});
  bool asked = false;
  while (!session->over() && !asked) {
    const std::string keys = session->terminal().keys(TurnSession::kWaitMs);
    asked = keys.find_first_not_of(' ') != std::string::npos;
    if (!keys.empty() && !asked) {
      loop.hold_key();
    }
    session->show(loop.status());
  }
  const int ended = session->finish();
  if (const TurnMeasure::Result turned = loop.status().turned; turned.told_rad != 0.0) {
    say("turned", measured_text(turned));
  }
  return ended;
}

}  // namespace ivo::firmware::wheels
