#include "firmware/tools/wheels/check_guide.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ivo::firmware::wheels {
namespace {

constexpr double kTurnRad = 2.0 * std::numbers::pi;
constexpr double kMostExpected = 10'000.0;
constexpr double kMuchLess = 1.5;

// Also of a wheel that was stopped before it held its speed.
std::optional<double> speed_ratio(const TurnMeasure::Result& turned) noexcept {
  if (turned.steady > Duration::zero()) {
    return turned.steady_radps / turned.steady_told_radps;
  }
  if (turned.told_rad == 0.0 || turned.counts == 0) {
    return std::nullopt;
  }
  return turned.rad / turned.told_rad;
}

}  // namespace

CheckGuide::CheckGuide(const Robot& robot, double radps, double turns) noexcept : radps_(radps), turns_(turns) {
  std::ranges::transform(robot.drives, least_radps_.begin(), [](const DriveParameters& drive) {
    return 1.0 / std::abs(TurnMeasure::scale_of(drive).units_per_radps);
  });
}

TurnOrder CheckGuide::order() const noexcept {
  return {.wheel = wheel(),
          .radps = std::max(radps_ / expected_, least_radps_[wheel_]),
          .limit_rad = step_ == CheckStep::kTurnALittle ? kALittleRad : longer_ * turns_ * kTurnRad,
          .expected = expected_};
}

bool CheckGuide::over(const TurnStatus& status, bool enough) const noexcept {
  const TurnMeasure::Result& turned = status.turned;
  if (status.phase != TurnPhase::kOff) {
    return false;  // nobody is asked to come near a wheel under power
  }
  const bool some = std::abs(turned.told_rad) * expected_ >= kEnoughRad;
  const bool let_go = status.key == DeadMan::State::kReleased;
  return status.limit_reached || turned.note != TurnNote::kNone ||
         (some && (enough || (step_ == CheckStep::kTurnALittle && let_go)));
}

bool CheckGuide::moved(const TurnStatus& status) noexcept {
  const TurnMeasure::Result& turned = status.turned;
  const bool too_fast = turned.note == TurnNote::kTooFast && turned.told_rad != 0.0;
  if (too_fast && slower_ < kSlowerTries) {
    ++slower_;
    expected_ = std::clamp(std::abs(turned.rad / turned.told_rad), 1.5 * expected_, kMostExpected);
    return true;
  }
  if (turned.note != TurnNote::kNone) {
    now().note = turned.note;
    now().note_wheel = turned.note_wheel;
  }
  now().speed_ratio = speed_ratio(turned);
  if (slower_ > 0 && now().speed_ratio) {
    expected_ = std::clamp(std::abs(*now().speed_ratio), 1.0, kMostExpected);
  }
  if (step_ == CheckStep::kTurnALittle) {
    step_ = CheckStep::kWhichWheel;
  } else {
    now().turns_measured = std::abs(turned.rad) / kTurnRad;
    step_ = CheckStep::kHowManyTurns;
  }
  return false;
}

void CheckGuide::which(std::optional<Wheel> seen) noexcept {
  now().turned = seen;
  if (seen) {
    step_ = CheckStep::kForward;
  } else {
    next_wheel();
  }
}

void CheckGuide::forward(bool it_did) noexcept {
  now().forward = it_did;
  if (now().note == TurnNote::kNone) {
    step_ = CheckStep::kTurnRound;
  } else {
    next_wheel();  // it would be stopped again
  }
}

void CheckGuide::how_many(double turns) noexcept {
  now().turns_seen = turns;
  const double short_by = longer_ * turns_ / turns;
  if (longer_ == 1.0 && short_by > kMuchLess) {
    longer_ = std::min(short_by, kMostLonger);
    step_ = CheckStep::kTurnRound;
    return;
  }
  next_wheel();
}

void CheckGuide::again() noexcept {
  step_ = step_ == CheckStep::kHowManyTurns ? CheckStep::kTurnRound : CheckStep::kTurnALittle;
  now().note = TurnNote::kNone;
}

void CheckGuide::next_wheel() noexcept {
  now().checked = true;
  expected_ = 1.0;
  slower_ = 0;
  longer_ = 1.0;
  ++wheel_;
  step_ = wheel_ == kWheels ? CheckStep::kDone : CheckStep::kTurnALittle;
}

}  // namespace ivo::firmware::wheels
