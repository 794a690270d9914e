// The course of `ivo wheels check`: what is to be turned and asked next, and what was found. It knows no terminal.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "config/robot.hpp"
#include "firmware/tools/wheels/wheel_turner.hpp"

namespace ivo::firmware::wheels {

/// Of the wheel that the robot file calls by its table's name.
struct WheelObservation {
  bool checked = false;
  std::optional<Wheel> turned;  ///< the wheel that was seen to turn; none: nobody saw one turn
  bool forward = true;
  std::optional<double> turns_seen;   ///< of the wheel, by its mark
  double turns_measured = 0.0;        ///< by its position, in the same time
  std::optional<double> speed_ratio;  ///< measured by told
  TurnNote note = TurnNote::kNone;    ///< that nothing explained
  Wheel note_wheel = Wheel::kFrontLeft;
};

enum class CheckStep : std::uint8_t { kTurnALittle, kWhichWheel, kForward, kTurnRound, kHowManyTurns, kDone };

/// For each wheel: turn a little; which one was it, did it go forward; turn round; how many turns did it make? A wheel
/// that turns much faster than told is told less and turned anew; one that made much less than its turn is turned
/// further once, for the eye tells parts of a turn badly.
class CheckGuide {
 public:
  static constexpr double kALittleRad = 1.5;
  static constexpr double kEnoughRad = 0.3;  ///< told; less is not worth a question
  static constexpr int kSlowerTries = 3;
  static constexpr double kMostLonger = 4.0;  ///< times as far, for a wheel that made less than its turn

  /// `radps` and `turns` are above 0.
  CheckGuide(const Robot& robot, double radps, double turns) noexcept;

  [[nodiscard]] CheckStep step() const noexcept { return step_; }
  [[nodiscard]] Wheel wheel() const noexcept { return static_cast<Wheel>(wheel_); }
  [[nodiscard]] bool turning() const noexcept {
    return step_ == CheckStep::kTurnALittle || step_ == CheckStep::kTurnRound;
  }
  /// Of a turning step.
  [[nodiscard]] TurnOrder order() const noexcept;
  /// The motion of a turning step is over, and power off: at its end, stopped by a note, or let go after a bit.
  /// `enough`: the person says so.
  [[nodiscard]] bool over(const TurnStatus& status, bool enough) const noexcept;

  /// To the next step. True when the same motion is asked for once more, slower.
  bool moved(const TurnStatus& status) noexcept;
  void which(std::optional<Wheel> seen) noexcept;
  void forward(bool it_did) noexcept;
  void how_many(double turns) noexcept;
  /// The motion before this question once more.
  void again() noexcept;

  [[nodiscard]] const std::array<WheelObservation, kWheels>& observations() const noexcept { return seen_; }

 private:
  [[nodiscard]] WheelObservation& now() noexcept { return seen_[wheel_]; }
  void next_wheel() noexcept;

  double radps_;
  double turns_;
  std::array<double, kWheels> least_radps_{};  // one unit of 60FFh
  CheckStep step_ = CheckStep::kTurnALittle;
  std::size_t wheel_ = 0;
  double expected_ = 1.0;  // times as fast as told this wheel turns
  int slower_ = 0;
  double longer_ = 1.0;  // times as far, by its position
  std::array<WheelObservation, kWheels> seen_;
};

}  // namespace ivo::firmware::wheels
