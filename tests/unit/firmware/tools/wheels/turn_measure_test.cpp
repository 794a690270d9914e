#include "firmware/tools/wheels/turn_measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

/// A front left wheel whose speeds are told and real as functions of time in seconds.
class Wheels {
 public:
  explicit Wheels(const DriveParameters& drive = {}, double expected = 1.0) : scale_(TurnMeasure::scale_of(drive)) {
    measure_.begin(Wheel::kFrontLeft, scale_, expected, angles_);
  }

  /// The first note within `time`, and when it came.
  TurnNote run(Duration time, const std::function<double(double)>& told, const std::function<double(double)>& real) {
    for (const Instant end = now_ + time; now_ < end;) {
      now_ += 2ms;
      const double t = seconds(now_.time_since_epoch());
      exact_rad_ += real(t) * 0.002;
      angles_[0] = std::round(exact_rad_ * scale_.counts_per_rad) / scale_.counts_per_rad;  // as counted
      measure_.update({.now = now_, .dt = 2ms, .told_radps = told(t), .angles_rad = angles_});
      if (measure_.result().note != TurnNote::kNone) {
        break;
      }
    }
    return measure_.result().note;
  }

  [[nodiscard]] const TurnMeasure::Result& result() const { return measure_.result(); }
  [[nodiscard]] Instant now() const { return now_; }
  std::array<double, kWheels>& angles() { return angles_; }

 private:
  TurnMeasure::Scale scale_;
  TurnMeasure measure_;
  std::array<double, kWheels> angles_{};
  double exact_rad_ = 0.0;
  Instant now_{};
};

double ramp_to_one(double t) { return std::min(1.0, t); }

TEST(TurnMeasure, NotesNothingOfAWheelThatFollows) {
  Wheels wheels;
  EXPECT_EQ(wheels.run(10s, ramp_to_one, [](double t) { return ramp_to_one(std::max(0.0, t - 0.1)); }),
            TurnNote::kNone);
  EXPECT_NEAR(wheels.result().steady_radps, 1.0, 1e-3);
  EXPECT_NEAR(seconds(wheels.result().steady), 8.5, 0.01);
  EXPECT_NEAR(wheels.result().rad, 9.4, 0.01);
}

TEST(TurnMeasure, ACoarseEncoderIsNotTakenForARunaway) {
  DriveParameters coarse;
  coarse.counts_per_turn = 24.0;
  Wheels wheels(coarse);
  EXPECT_EQ(wheels.run(20s, ramp_to_one, ramp_to_one), TurnNote::kNone);
}

TEST(TurnMeasure, NotesAWheelThatTurnsTooFastWithinAFifthOfASecond) {
  Wheels wheels;
  EXPECT_EQ(wheels.run(2s, ramp_to_one, ramp_to_one), TurnNote::kNone);
  const Instant begin = wheels.now();
  EXPECT_EQ(wheels.run(2s, ramp_to_one, [](double) { return 3.0; }), TurnNote::kTooFast);
  EXPECT_LE(wheels.now() - begin, 200ms);
}

TEST(TurnMeasure, AWheelThatIsKnownToBeFastMayBeSoFastButNoFaster) {
  const auto slow = [](double t) { return 0.1 * ramp_to_one(t); };
  Wheels known({}, 5.0);
  EXPECT_EQ(known.run(5s, slow, [&](double t) { return 5.0 * slow(t); }), TurnNote::kNone);
  EXPECT_EQ(known.run(5s, slow, [&](double t) { return 15.0 * slow(t); }), TurnNote::kTooFast);
}

TEST(TurnMeasure, ForgivesADriveThatSlowsDownLateButNotOneThatGoesOn) {
  const auto told = [](double t) { return t < 3.0 ? ramp_to_one(t) : 0.0; };
  Wheels late;
  EXPECT_EQ(late.run(6s, told, [](double t) { return t < 3.0 ? ramp_to_one(t) : std::max(0.0, 1.0 - (t - 3.0)); }),
            TurnNote::kNone);
  Wheels on;
  EXPECT_EQ(on.run(6s, told, ramp_to_one), TurnNote::kTooFast);
  EXPECT_LT(on.now(), Instant(4500ms));
}

TEST(TurnMeasure, NotesAPositionThatStays) {
  Wheels wheels;
  EXPECT_EQ(wheels.run(5s, ramp_to_one, [](double) { return 0.0; }), TurnNote::kStays);
  EXPECT_LT(wheels.now(), Instant(1500ms));
}

TEST(TurnMeasure, NotesAPositionThatCountsBackward) {
  Wheels wheels;
  EXPECT_EQ(wheels.run(5s, ramp_to_one, [](double t) { return -ramp_to_one(t); }), TurnNote::kAgainst);
}

TEST(TurnMeasure, NotesAnotherWheelThatMovesWhileThisOneIsToldTo) {
  Wheels wheels;
  const auto still = [](double) { return 0.0; };
  wheels.angles()[2] += 1.0;  // by hand, while this one stands: nobody minds
  EXPECT_EQ(wheels.run(100ms, still, still), TurnNote::kNone);
  EXPECT_EQ(wheels.run(2s, ramp_to_one, ramp_to_one), TurnNote::kNone);
  wheels.angles()[2] += 0.3;
  EXPECT_EQ(wheels.run(100ms, ramp_to_one, ramp_to_one), TurnNote::kOtherMoves);
  EXPECT_EQ(wheels.result().note_wheel, Wheel::kRearLeft);
}

TEST(TurnMeasure, SignsAndGearsAreTakenOutOfItsFigures) {
  DriveParameters drive;
  drive.sign = -1;
  drive.gear_ratio = 20.0;
  Wheels wheels(drive);
  wheels.run(5s, ramp_to_one, ramp_to_one);
  EXPECT_GT(wheels.result().rad, 4.0);
  EXPECT_EQ(wheels.result().counts, std::llround(-wheels.result().rad * 20.0 * 4096.0 / (2.0 * std::numbers::pi)));
  EXPECT_LT(wheels.result().told_units, 0);
  EXPECT_GT(wheels.result().told_radps, 0.99);
}

}  // namespace
}  // namespace ivo::firmware
