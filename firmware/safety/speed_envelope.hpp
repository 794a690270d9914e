// Between which speeds a wheel may be that does what it is told, be its drive quick or slow.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "config/base/time.hpp"

namespace ivo::firmware {

/// A drive follows with a lag and on a ramp of its own, neither of which we know; we know bounds. It is then between
/// the lowest and the highest of the speeds that it was told within `lag`, and where those have come nearer to each
/// other faster than the gentlest ramp allows, between where that ramp would be.
class SpeedEnvelope {
 public:
  /// Both above 0.
  SpeedEnvelope(Duration lag, double gentlest_ramp_mps2) noexcept
      : bin_(lag / static_cast<Duration::rep>(kBins - 1)), ramp_mps2_(gentlest_ramp_mps2) {}

  /// At rest, and told to rest, for long.
  void reset(Instant now) noexcept {
    bins_ = {};
    used_ = 0;
    told_mps_ = low_mps_ = high_mps_ = 0.0;
    reached_ = now;
  }

  /// Told `told_mps` from `now` on. Cost: a look at kBins spans.
  void update(double told_mps, Instant now) noexcept {
    // What was told before held until now: a new span begins with it.
    if (used_ == 0 || now - newest().begin >= bin_) {
      bins_[used_++ % kBins] = {now, told_mps_, told_mps_};
    }
    Span& open = bins_[(used_ - 1) % kBins];
    open.low_mps = std::min(open.low_mps, told_mps);
    open.high_mps = std::max(open.high_mps, told_mps);
    told_mps_ = told_mps;
    const double ramp_mps = ramp_mps2_ * std::max(0.0, seconds(now - reached_));
    reached_ = now;
    // A span reaches as far as the next one begins: those that began a span before the lag still count.
    double low_mps = told_mps;
    double high_mps = told_mps;
    for (std::size_t i = 0; i < std::min(used_, kBins); ++i) {
      if (now - bins_[i].begin <= static_cast<Duration::rep>(kBins) * bin_) {
        low_mps = std::min(low_mps, bins_[i].low_mps);
        high_mps = std::max(high_mps, bins_[i].high_mps);
      }
    }
    low_mps_ = std::min(low_mps, low_mps_ + ramp_mps);
    high_mps_ = std::max(high_mps, high_mps_ - ramp_mps);
  }

  [[nodiscard]] double low_mps() const noexcept { return low_mps_; }
  [[nodiscard]] double high_mps() const noexcept { return high_mps_; }
  /// Of the speeds within the one nearest to rest, with its direction.
  [[nodiscard]] double least_mps() const noexcept { return low_mps_ > 0.0 ? low_mps_ : std::min(high_mps_, 0.0); }
  [[nodiscard]] double most_mps() const noexcept { return std::max(high_mps_, -low_mps_); }
  /// How far `speed_mps` lies outside; 0 within, infinity when it is not a number.
  [[nodiscard]] double outside_mps(double speed_mps) const noexcept {
    return std::isnan(speed_mps) ? std::numeric_limits<double>::infinity()
                                 : std::max({0.0, low_mps_ - speed_mps, speed_mps - high_mps_});
  }

 private:
  static constexpr std::size_t kBins = 16;
  struct Span {
    Instant begin{};
    double low_mps = 0.0;
    double high_mps = 0.0;
  };
  [[nodiscard]] const Span& newest() const noexcept { return bins_[(used_ - 1) % kBins]; }

  Duration bin_;
  double ramp_mps2_;
  std::array<Span, kBins> bins_{};
  std::size_t used_ = 0;
  double told_mps_ = 0.0;
  double low_mps_ = 0.0;
  double high_mps_ = 0.0;
  Instant reached_{};
};

}  // namespace ivo::firmware
