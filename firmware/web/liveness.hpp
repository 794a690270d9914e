// Is the link of who would set the robot off good enough: both ways, within the last second?
#pragma once

#include <chrono>
#include <optional>

#include "config/base/time.hpp"

namespace ivo::firmware::web {

/// One connection's.
class Liveness {
 public:
  static constexpr Duration kFresh = std::chrono::seconds(1);

  void beat(Instant now) noexcept { beat_ = now; }
  /// A status has been written to it to its last byte.
  void status_written(Instant now) noexcept { written_ = now; }
  [[nodiscard]] bool fresh(Instant now) const noexcept {
    return beat_ && written_ && now - *beat_ <= kFresh && now - *written_ <= kFresh;
  }

 private:
  std::optional<Instant> beat_;
  std::optional<Instant> written_;
};

}  // namespace ivo::firmware::web
