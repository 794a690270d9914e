// The first of two doors that motion passes: judges the commanded twist. What is not allowed is refused whole and
// becomes 0; nothing is clamped here, because a command beyond a limit is a fault of whoever made it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "config/base/geometry.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::firmware {

/// Why a command did not pass, in the order of the checks.
enum class Refusal : std::uint8_t {
  kNone,
  kModeForbids,
  kDrivesNotEnabled,
  kFeedbackStale,  ///< older than the limit, or from the future
  kPoseNotFinite,
  kCommandNotFinite,
  kTooFast,
  kTurnsTooFast,
};
inline constexpr int kRefusals = 8;

[[nodiscard]] std::string_view name_of(Refusal refusal) noexcept;

class CommandGate {
 public:
  /// Nothing passes unless all of it is said.
  struct Input {
    bool may_move = false;  ///< Permissions::may_move of the mode
    bool drives_enabled = false;
    Duration feedback_age = Duration::max();  ///< of the oldest of the four drives' feedback
    Pose pose;
    Twist command;
  };
  struct Verdict {
    Twist command;  ///< the command, or 0
    Refusal refusal = Refusal::kNone;
  };

  /// The largest speeds are those of `limits`; feedback is fresh up to and including `feedback_age_limit`.
  CommandGate(const MotionLimits& limits, Duration feedback_age_limit) noexcept
      : limits_(limits), feedback_age_limit_(feedback_age_limit) {}

  /// One cycle.
  [[nodiscard]] Verdict judge(const Input& input) noexcept;

  /// How often a command was refused for this reason. Commands of exactly 0 are judged but not counted: nothing was
  /// asked for, and the count would bury the refusals that matter.
  [[nodiscard]] std::uint64_t refused(Refusal reason) const noexcept;

 private:
  [[nodiscard]] Refusal reason_against(const Input& input) const noexcept;

  MotionLimits limits_;
  Duration feedback_age_limit_;
  std::array<std::uint64_t, kRefusals> refused_{};
};

}  // namespace ivo::firmware
