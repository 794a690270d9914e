#include "firmware/tools/wheels/wheel_findings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "firmware/files/number_text.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/state_words.hpp"
#include "firmware/tools/wheels/turn_text.hpp"

namespace ivo::firmware::wheels {
namespace {

double rounded(double value, int digits) {
  const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

// A ratio that was seen by eye is a whole number, or one over it, when it is as near to one as the eye can tell.
double plain_ratio(double ratio, double eye_error) {
  const double whole = std::round(ratio >= 1.0 ? ratio : 1.0 / ratio);
  const double plain = ratio >= 1.0 ? whole : 1.0 / whole;
  return std::abs(ratio / plain - 1.0) <= eye_error ? plain : ratio;
}

double near_whole(double value, double eye_error) {
  const double whole = std::round(value);
  return whole > 0.0 && std::abs(value / whole - 1.0) <= eye_error ? whole : rounded(value, 4);
}

std::string percent(double ratio) {
  const double tenths = std::round(1000.0 * (ratio - 1.0));
  return format("%+.1f %%", tenths == 0.0 ? 0.0 : tenths / 10.0);
}

std::string speed_text(double ratio) {
  if (ratio > 2.0 || ratio < 0.5) {
    return format("turns %.3g times as fast as told", ratio);
  }
  return format("turns %.1f %% %s than told", 100.0 * std::abs(ratio - 1.0), ratio > 1.0 ? "faster" : "slower");
}

class Report {
 public:
  Report(const Robot& robot, const std::array<WheelObservation, kWheels>& seen) : robot_(robot), seen_(seen) {}

  Findings findings() {
    find_places();
    for (int wheel = 0; wheel < kWheels; ++wheel) {
      describe(static_cast<Wheel>(wheel));
    }
    if (!places_clear_) {
      found_.lines.emplace_back(
          "two drives are said to turn one wheel: node-ids cannot be told from that; check once more");
      wrong_ = true;
    }
    for (int wheel = 0; wheel < kWheels; ++wheel) {
      write_toml(static_cast<Wheel>(wheel));
    }
    found_.all_right = !wrong_ && found_.toml.empty();
    return found_;
  }

 private:
  [[nodiscard]] const DriveParameters& drive(Wheel wheel) const {
    return robot_.drives[static_cast<std::size_t>(wheel)];
  }

  // Which table's drive turns each wheel.
  void find_places() {
    for (int told = 0; told < kWheels; ++told) {
      const WheelObservation& seen = seen_[static_cast<std::size_t>(told)];
      if (!seen.turned) {
        continue;
      }
      auto& place = drive_at_[static_cast<std::size_t>(*seen.turned)];
      places_clear_ = places_clear_ && !place.has_value();
      place = static_cast<Wheel>(told);
    }
  }

  void describe(Wheel wheel) {
    const WheelObservation& seen = seen_[static_cast<std::size_t>(wheel)];
    const std::string name = wheel_text(robot_, wheel) + ": ";
    if (!seen.checked) {
      wrong_ = true;
      found_.lines.push_back(name + "not checked");
      return;
    }
    std::vector<std::string> faults;
    if (!seen.turned) {
      faults.emplace_back("nobody saw a wheel turn");
    } else if (*seen.turned != wheel) {
      faults.push_back("it is " + std::string(name_of(*seen.turned)) + " that turns");
    }
    if (seen.note != TurnNote::kNone) {
      wrong_ = true;
      faults.push_back(cause(seen));
    }
    const Correction right = correct(drive(wheel), seen);
    if (right.sign) {
      faults.emplace_back("turns backward");
    }
    if (seen.turns_seen && (right.gear || right.counts)) {
      faults.push_back(format("made %.2f turns where its position says %.2f", *seen.turns_seen, seen.turns_measured));
    }
    if (seen.speed_ratio && seen.turns_seen && (right.gear || right.velocity)) {
      const double speed = *seen.speed_ratio * *seen.turns_seen / seen.turns_measured;
      faults.push_back(speed_text(speed));
    }
    std::string line = name;
    for (const std::string& fault : faults) {
      line += (line == name ? "" : "; ") + fault;
    }
    if (faults.empty()) {
      line +=
          format("right; speed %s, sign and turns as they should be", percent(seen.speed_ratio.value_or(1.0)).c_str());
    }
    wrong_ = wrong_ || !seen.turned;
    found_.lines.push_back(line);
  }

  static std::string cause(const WheelObservation& seen) {
    switch (seen.note) {
      case TurnNote::kStays:
        return "its position hardly changes: wheel blocked, motor or encoder not connected, or velocity_per_radps far "
               "too low" +
               (seen.speed_ratio && *seen.speed_ratio > 0.0
                    ? format(" (%.3g of the speed that was told)", *seen.speed_ratio)
                    : std::string());
      case TurnNote::kAgainst:
        return "its position counts against its velocity: to be mended in the drive (encoder phases, or polarity "
               "607Eh)";
      case TurnNote::kOtherMoves:
        return "the position of " + std::string(name_of(seen.note_wheel)) + " changed too: encoders exchanged?";
      case TurnNote::kTooFast:
        return "by its position it turns much faster than told";
      case TurnNote::kNone:
        break;
    }
    return {};
  }

  /// The lines of [drive.`place`] that differ from what the drive there needs.
  void write_toml(Wheel place) {
    const auto found = drive_at_[static_cast<std::size_t>(place)];
    if (!found || !places_clear_) {
      return;
    }
    const DriveParameters& is = drive(place);
    const Correction right = correct(drive(*found), seen_[static_cast<std::size_t>(*found)]);
    const DriveParameters& should = right.drive;
    std::vector<std::string> keys;
    const auto change = [&](const char* key, const std::string& value, const std::string& was) {
      if (value != was) {
        keys.push_back(std::string(key) + " = " + value + "  # was " + was);
      }
    };
    change("node_id", std::to_string(should.node_id), std::to_string(is.node_id));
    change("sign", std::to_string(should.sign), std::to_string(is.sign));
    change("gear_ratio", shortest(should.gear_ratio), shortest(is.gear_ratio));
    change("counts_per_turn", shortest(should.counts_per_turn), shortest(is.counts_per_turn));
    change("velocity_per_radps", shortest(should.velocity_per_radps), shortest(is.velocity_per_radps));
    change("accel_per_radps2", shortest(should.accel_per_radps2), shortest(is.accel_per_radps2));
    change("vendor_id", std::to_string(should.vendor_id), std::to_string(is.vendor_id));
    change("product_code", std::to_string(should.product_code), std::to_string(is.product_code));
    change("eds", '"' + should.eds + '"', '"' + is.eds + '"');
    if (keys.empty()) {
      return;
    }
    if (!found_.toml.empty()) {
      found_.toml.emplace_back();
    }
    found_.toml.push_back("[drive." + std::string(key_of(place)) + "]");
    found_.toml.insert(found_.toml.end(), keys.begin(), keys.end());
  }

  const Robot& robot_;
  const std::array<WheelObservation, kWheels>& seen_;
  Findings found_;
  std::array<std::optional<Wheel>, kWheels> drive_at_{};
  bool places_clear_ = true;
  bool wrong_ = false;
};

}  // namespace

Correction correct(const DriveParameters& drive, const WheelObservation& seen) {
  Correction right{.drive = drive};
  if (!seen.turned) {
    return right;
  }
  right.sign = !seen.forward;
  right.drive.sign = seen.forward ? drive.sign : -drive.sign;
  if (!seen.turns_seen || !seen.speed_ratio || !(seen.turns_measured > 0.0) || !(*seen.speed_ratio > 0.0)) {
    return right;
  }
  const double eye_error = kEyeTurns / *seen.turns_seen;
  const double turns = plain_ratio(*seen.turns_seen / seen.turns_measured, eye_error);  // true for one measured
  const double speed = *seen.speed_ratio * turns;                                       // true for one told
  const bool counts_off = turns != 1.0;
  const bool exact = turns == std::round(turns) || 1.0 / turns == std::round(1.0 / turns);
  const bool speed_off = std::abs(speed - 1.0) > kSpeedError + (exact ? 0.0 : eye_error);
  if (counts_off && std::abs(*seen.speed_ratio - 1.0) <= kSpeedError) {
    right.gear = true;
    right.drive.gear_ratio = near_whole(drive.gear_ratio / turns, eye_error);
    return right;
  }
  if (counts_off) {
    right.counts = true;
    right.drive.counts_per_turn = near_whole(drive.counts_per_turn / turns, eye_error);
  }
  if (speed_off) {
    right.velocity = true;
    right.drive.velocity_per_radps = rounded(drive.velocity_per_radps / speed, 5);
  }
  return right;
}

Findings findings_of(const Robot& robot, const std::array<WheelObservation, kWheels>& seen) {
  return Report(robot, seen).findings();
}

}  // namespace ivo::firmware::wheels
