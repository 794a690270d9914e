// What a check found, and which lines of the robot file would mend it. Nothing is written anywhere.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "firmware/tools/wheels/check_guide.hpp"

namespace ivo::firmware::wheels {

struct Findings {
  std::vector<std::string> lines;  ///< a sentence each, wheel by wheel
  std::vector<std::string> toml;   ///< what to change in the robot file; empty when nothing
  bool all_right = false;          ///< all four were checked and nothing is to be changed or mended
};

/// The eye sees where a mark is to about this part of a turn; a speed is known to kSpeedError of itself.
inline constexpr double kEyeTurns = 0.03;
inline constexpr double kSpeedError = 0.02;

/// Of a drive, with what was seen of the wheel that it turns.
struct Correction {
  DriveParameters drive;  ///< as it should be
  bool sign = false;
  bool gear = false;
  bool counts = false;
  bool velocity = false;
};

/// With c = counts for one turn of the wheel and v = units of 60FFh for 1 rad/s of it, both in proportion to the gear:
/// when both are off by one factor the gear ratio is wrong, else counts_per_turn is what c says and velocity_per_radps
/// what v says.
[[nodiscard]] Correction correct(const DriveParameters& drive, const WheelObservation& seen);

[[nodiscard]] Findings findings_of(const Robot& robot, const std::array<WheelObservation, kWheels>& seen);

}  // namespace ivo::firmware::wheels
