// How much a ROS client may say: a scanner or a localisation may be quicker than anybody needs.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "config/base/time.hpp"
#include "firmware/console/console_messages.hpp"
#include "firmware/web/request.hpp"

namespace ivo::firmware::web {

class RosPace {
 public:
  static constexpr std::size_t kMessagesPerSecond = 400;
  static constexpr std::size_t kBytesPerSecond = 16U << 20U;
  static constexpr std::size_t kShortBytes = 1024;  ///< of a message that may be a stop
  static constexpr std::size_t kStopsPerSecond = 100;
  static constexpr Duration kPositionPeriod = std::chrono::milliseconds(90);  ///< of an agent

  /// False for what is beyond the second's share.
  [[nodiscard]] bool may_say(std::size_t bytes, Instant now) {
    begin_second(now);
    messages_ += 1;
    bytes_ += bytes;
    return messages_ <= kMessagesPerSecond && bytes_ <= kBytesPerSecond;
  }

  /// Of messages that are looked at whatever else is said.
  [[nodiscard]] bool may_stop(Instant now) {
    begin_second(now);
    return ++stops_ <= kStopsPerSecond;
  }

  /// False for a position that comes so soon after the agent's one before that it says nothing new.
  [[nodiscard]] bool worth_asking(const Request& request, Instant now) {
    const auto* const position = std::get_if<Position>(&request);
    if (position == nullptr || position->agent >= kAgents) {
      return true;
    }
    std::optional<Instant>& last = position_[position->agent];
    if (last && now - *last < kPositionPeriod) {
      return false;
    }
    last = now;
    return true;
  }

 private:
  static constexpr std::size_t kAgents = console::kAgents;

  void begin_second(Instant now) {
    if (!second_ || now - *second_ >= std::chrono::seconds(1) || now < *second_) {
      second_ = now;
      messages_ = bytes_ = stops_ = 0;
    }
  }

  std::optional<Instant> second_;
  std::size_t messages_ = 0;
  std::size_t bytes_ = 0;
  std::size_t stops_ = 0;
  std::array<std::optional<Instant>, kAgents> position_;
};

}  // namespace ivo::firmware::web
