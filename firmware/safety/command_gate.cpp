#include "firmware/safety/command_gate.hpp"

#include <cmath>
#include <cstddef>

namespace ivo::firmware {
namespace {

constexpr std::array<std::string_view, kRefusals> kRefusalNames{
    "none",     "mode forbids motion", "drives not enabled", "feedback stale", "pose not finite", "command not finite",
    "too fast", "turns too fast",
};

// A vector that was scaled to the limit can come out a few last bits beyond it.
constexpr double kRounding = 1.0 + 1e-9;

bool asks_for_motion(const Twist& t) noexcept { return !(t.vx_mps == 0 && t.vy_mps == 0 && t.wz_radps == 0); }

// False as well when either is not a number.
bool within(double value, double limit) noexcept { return value <= limit * kRounding; }

}  // namespace

std::string_view name_of(Refusal refusal) noexcept { return kRefusalNames[static_cast<std::size_t>(refusal)]; }

CommandGate::Verdict CommandGate::judge(const Input& input) noexcept {
  const Refusal refusal = reason_against(input);
  if (refusal == Refusal::kNone) {
    return {input.command, refusal};
  }
  if (asks_for_motion(input.command)) {
    ++refused_[static_cast<std::size_t>(refusal)];
  }
  return {{}, refusal};
}

std::uint64_t CommandGate::refused(Refusal reason) const noexcept { return refused_[static_cast<std::size_t>(reason)]; }

Refusal CommandGate::reason_against(const Input& input) const noexcept {
  const Pose& pose = input.pose;
  const Twist& command = input.command;
  if (!input.may_move) {
    return Refusal::kModeForbids;
  }
  if (!input.drives_enabled) {
    return Refusal::kDrivesNotEnabled;
  }
  if (input.feedback_age < Duration::zero() || input.feedback_age > feedback_age_limit_) {
    return Refusal::kFeedbackStale;
  }
  if (!std::isfinite(pose.x_m) || !std::isfinite(pose.y_m) || !std::isfinite(pose.heading_rad)) {
    return Refusal::kPoseNotFinite;
  }
  if (!std::isfinite(command.vx_mps) || !std::isfinite(command.vy_mps) || !std::isfinite(command.wz_radps)) {
    return Refusal::kCommandNotFinite;
  }
  if (!within(std::hypot(command.vx_mps, command.vy_mps), limits_.max_speed_mps)) {
    return Refusal::kTooFast;
  }
  if (!within(std::abs(command.wz_radps), limits_.max_turn_radps)) {
    return Refusal::kTurnsTooFast;
  }
  return Refusal::kNone;
}

}  // namespace ivo::firmware
