// Four wheels with their drives, as unlike each other as real ones: each lags, ramps, shivers and counts in its own
// way.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <random>

#include "config/robot.hpp"
#include "firmware/motion/kinematics.hpp"

namespace ivo::test {

class SimulatedWheels {
 public:
  struct Drive {
    double dead_time_s = 0.004;  ///< until a target acts
    double lag_s = 0.03;         ///< of the speed loop, first order
    double ramp_mps2 = 2.0;      ///< 6083h, 6084h at the rim
    double radius_error = 0.0;   ///< share: the floor turns the wheel faster or slower than told
    double noise_mps = 0.01;     ///< of the speed, new in each cycle
    double follows = 1.0;        ///< of the target: 0 blocked, below 0 turns the other way
    double driven_mps = 0.0;     ///< on top, from outside
    bool encoder_works = true;
  };

  SimulatedWheels(const Robot& robot, std::uint64_t seed) : robot_(robot), random_(seed) {}

  /// Each drive drawn anew, within what a healthy one does.
  void draw_drives() {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (Drive& drive : drives) {
      drive.dead_time_s = 0.002 + 0.004 * share(random_);
      drive.lag_s = 0.005 + 0.055 * share(random_);
      drive.ramp_mps2 = robot_.limits.max_accel_mps2 * (1.0 + 3.0 * share(random_));
      drive.radius_error = 0.02 * (2.0 * share(random_) - 1.0);
      drive.noise_mps = 0.02 * share(random_);
    }
  }

  /// One cycle at these targets.
  void step(const firmware::WheelValues& told_radps) {
    const double dt_s = seconds(robot_.cycle);
    told_.push_front(told_radps);
    if (told_.size() > 32) {
      told_.pop_back();
    }
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const Drive& drive = drives[i];
      const auto late = std::min(told_.size() - 1, static_cast<std::size_t>(std::lround(drive.dead_time_s / dt_s)));
      const double target_mps = drive.follows * told_[late][i] * robot_.base.wheel_radius_m;
      ramped_mps_[i] += std::clamp(target_mps - ramped_mps_[i], -drive.ramp_mps2 * dt_s, drive.ramp_mps2 * dt_s);
      speed_mps_[i] += (ramped_mps_[i] - speed_mps_[i]) * (1.0 - std::exp(-dt_s / drive.lag_s));
      const double shiver_mps = drive.follows == 0.0 ? 0.0 : drive.noise_mps * std::normal_distribution<>()(random_);
      const double turns_mps = speed_mps_[i] * (1.0 + drive.radius_error) + shiver_mps + drive.driven_mps;
      angle_rad_[i] += drive.encoder_works ? turns_mps / robot_.base.wheel_radius_m * dt_s : 0.0;
    }
  }

  /// In whole counts, as encoders say it.
  [[nodiscard]] firmware::WheelValues angle_rad() const {
    firmware::WheelValues counted{};
    for (std::size_t i = 0; i < counted.size(); ++i) {
      const double count_rad =
          2.0 * std::numbers::pi / (robot_.drives[i].counts_per_turn * robot_.drives[i].gear_ratio);
      counted[i] = std::floor(angle_rad_[i] / count_rad) * count_rad;
    }
    return counted;
  }

  std::array<Drive, kWheels> drives{};

 private:
  Robot robot_;
  std::mt19937_64 random_;
  std::deque<firmware::WheelValues> told_;
  std::array<double, kWheels> ramped_mps_{};
  std::array<double, kWheels> speed_mps_{};
  std::array<double, kWheels> angle_rad_{};
};

}  // namespace ivo::test
