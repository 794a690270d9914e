#include "drivers/canopen/response_time.hpp"

#include <algorithm>

#include "config/base/contract.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/frame_bits.hpp"

namespace ivo::drivers {
namespace {

using Nanoseconds = std::int64_t;

// Of a bus that is never silent for so long nobody waits for an answer; it also bounds the loops.
constexpr Nanoseconds kLongestBusy = 1'000'000'000;

constexpr Nanoseconds up(Nanoseconds a, Nanoseconds b) noexcept { return (a + b - 1) / b; }

struct Sent {
  Nanoseconds length = 0;  // C
  Nanoseconds period = 0;  // T
  Nanoseconds jitter = 0;  // J
};

class Analysis {
 public:
  explicit Analysis(std::uint32_t bit_rate_bps) noexcept
      : bit_rate_(bit_rate_bps), bit_(up(1'000'000'000, bit_rate_)) {}

  [[nodiscard]] Nanoseconds length_of(std::uint8_t bytes) const noexcept {
    return up(Nanoseconds{longest_bits(bytes)} * 1'000'000'000, bit_rate_);
  }

  /// Of the last of `sent`, all others of which have a higher priority; `blocking`: B.
  [[nodiscard]] std::optional<Nanoseconds> worst(std::span<const Sent> sent, Nanoseconds blocking) const noexcept {
    const Sent& own = sent.back();
    const std::span<const Sent> higher = sent.first(sent.size() - 1);
    // Equation 8: how long the bus may go on without a pause in which a frame of lower priority could begin.
    const std::optional<Nanoseconds> busy = grow(own.length, [&](Nanoseconds t) { return blocking + demand(sent, t); });
    if (!busy.has_value()) {
      return std::nullopt;
    }
    Nanoseconds most = 0;
    const Nanoseconds instances = up(*busy + own.jitter, own.period);  // equation 10
    for (Nanoseconds q = 0; q < instances; ++q) {
      const auto queueing = [&](Nanoseconds w) { return blocking + q * own.length + demand(higher, w + bit_); };
      const std::optional<Nanoseconds> waits = grow(blocking + q * own.length, queueing);  // equation 11
      if (!waits.has_value()) {
        return std::nullopt;
      }
      most = std::max(most, own.jitter + *waits - q * own.period + own.length);  // equation 12
    }
    return most;
  }

 private:
  static Nanoseconds demand(std::span<const Sent> sent, Nanoseconds time) noexcept {
    Nanoseconds sum = 0;
    for (const Sent& frame : sent) {
      sum += up(time + frame.jitter, frame.period) * frame.length;
    }
    return sum;
  }

  /// The least fixed point of `next` from `start` on, if it is reached.
  template <class Next>
  static std::optional<Nanoseconds> grow(Nanoseconds start, const Next& next) noexcept {
    Nanoseconds value = start;
    for (Nanoseconds grown = next(value); grown != value; grown = next(value)) {
      value = grown;
      if (value > kLongestBusy) {
        return std::nullopt;
      }
    }
    return value;
  }

  Nanoseconds bit_rate_;
  Nanoseconds bit_;
};

}  // namespace

ResponseTimes response_times(const BusSchedule& schedule, std::uint32_t bit_rate_bps,
                             std::optional<std::uint8_t> other_bytes) noexcept {
  IVO_CONTRACT(bit_rate_bps > 0);
  BusSchedule sorted = schedule;
  const std::span<PeriodicFrame> frames(sorted.begin(), sorted.end());
  std::sort(frames.begin(), frames.end(), [](const PeriodicFrame& a, const PeriodicFrame& b) { return a.id < b.id; });

  const Analysis analysis(bit_rate_bps);
  ResponseTimes times;
  StaticVector<Sent, BusSchedule::capacity()> sent;
  std::optional<Nanoseconds> sync = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const PeriodicFrame& frame = frames[i];
    IVO_CONTRACT(frame.period > Duration::zero());
    IVO_CONTRACT(sent.push_back(
        {analysis.length_of(frame.bytes), frame.period.count(), frame.after_sync ? sync.value_or(0) : 0}));
    Nanoseconds blocking = other_bytes.has_value() ? analysis.length_of(*other_bytes) : 0;
    for (const PeriodicFrame& lower : frames.subspan(i + 1)) {
      blocking = std::max(blocking, analysis.length_of(lower.bytes));
    }
    const std::optional<Nanoseconds> worst = analysis.worst(sent.span(), blocking);
    if (frame.id == cob_id::kSync) {
      sync = worst;
    }
    IVO_CONTRACT(times.push_back({frame, worst.has_value() ? std::optional(Duration(*worst)) : std::nullopt}));
  }
  return times;
}

}  // namespace ivo::drivers
