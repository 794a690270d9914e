// What a wheel does beside what it is told: how far, how fast, and what is odd about it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::firmware {

/// What stops a wheel at once; it turns again after the key was let go.
enum class TurnNote : std::uint8_t {
  kNone,
  kTooFast,     ///< by its position more than twice as fast as told, or as expected
  kStays,       ///< its position does not change
  kAgainst,     ///< its position counts against its velocity
  kOtherMoves,  ///< the position of another wheel changes
};

/// Speeds and angles are at the wheel as the robot file has it: after sign, gear and counts. Angles come from positions
/// alone; a speed is never differentiated over less than kWindow, or coarse encoders would look too fast.
class TurnMeasure {
 public:
  static constexpr Duration kWindow = std::chrono::milliseconds(200);
  static constexpr Duration kSteadyAfter = std::chrono::milliseconds(500);  ///< at one speed, before it is measured
  static constexpr double kTooFast = 2.0;
  static constexpr double kTooFastMarginRad = 0.05;               ///< in kWindow, and two counts
  static constexpr Duration kForgives = std::chrono::seconds(1);  ///< a drive that slows down late
  static constexpr double kStaysAfterRad = 0.5;                   ///< told to go so far, and gone no tenth of it
  static constexpr double kOtherRad = 0.2;

  struct Result {
    double told_radps = 0.0;      ///< now, as rounded to the drive's units
    std::int32_t told_units = 0;  ///< of 60FFh
    double radps = 0.0;           ///< measured now
    double told_rad = 0.0;        ///< the way it was told to go
    double rad = 0.0;             ///< the way it went
    std::int64_t counts = 0;      ///< of 6064h, as the drive counts
    Duration steady{};            ///< the longest time at one speed; 0: none was long enough to be measured
    double steady_told_radps = 0.0;
    double steady_radps = 0.0;  ///< mean over that time
    TurnNote note = TurnNote::kNone;
    Wheel note_wheel = Wheel::kFrontLeft;
  };

  /// What a radian a second, and a radian, at the wheel are to its drive.
  struct Scale {
    double units_per_radps = 1.0;  ///< of 60FFh, signed
    double counts_per_rad = 1.0;   ///< of 6064h, signed
  };
  [[nodiscard]] static Scale scale_of(const DriveParameters& drive) noexcept;

  /// Of `wheel`, from `angles_rad` on. `expected`: how many times as fast as told it is known to turn.
  void begin(Wheel wheel, const Scale& scale, double expected, const std::array<double, kWheels>& angles_rad) noexcept;

  struct Cycle {
    Instant now{};
    Duration dt{};
    double told_radps = 0.0;  ///< that the drive follows since the last cycle
    std::array<double, kWheels> angles_rad{};
  };
  void update(const Cycle& cycle) noexcept;
  void forget_note() noexcept;

  [[nodiscard]] const Result& result() const noexcept { return result_; }

 private:
  struct Sample {
    Instant when{};
    double rad = 0.0;
  };
  static constexpr std::size_t kSamples = 256;

  void take_sample(Instant now) noexcept;
  void measure_steady(Instant now) noexcept;
  void look_for_oddness(const Cycle& cycle) noexcept;
  void remark(TurnNote note, Wheel wheel) noexcept;

  Wheel wheel_ = Wheel::kFrontLeft;
  Scale scale_;
  double expected_ = 1.0;
  double begin_rad_ = 0.0;
  Result result_;
  std::array<double, kWheels> others_from_rad_{};  // since the wheel was last told to stand
  // Since the last note, or the beginning.
  double told_from_rad_ = 0.0;
  double from_rad_ = 0.0;
  // The fastest that it was told to turn within kForgives.
  double peak_radps_ = 0.0;
  Instant peak_at_{};
  // At one speed.
  double steady_told_radps_ = 0.0;
  Instant steady_since_{};
  double steady_from_rad_ = 0.0;
  // The last kWindow.
  std::array<Sample, kSamples> samples_{};
  std::size_t oldest_ = 0;  // counted, not wrapped
  std::size_t sampled_ = 0;
};

}  // namespace ivo::firmware
