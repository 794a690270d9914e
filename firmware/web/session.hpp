// One WebSocket connection, whoever is at the other end of it. The hub calls it; the server writes what it has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "config/base/time.hpp"
#include "firmware/web/controls.hpp"
#include "firmware/web/liveness.hpp"
#include "firmware/web/ros/ros_session.hpp"
#include "firmware/web/token_store.hpp"
#include "firmware/web/verdict.hpp"

namespace ivo::firmware::web {

class Session {
 public:
  Session(Screen screen, Paired paired) : screen_(screen), paired_(std::move(paired)) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  virtual ~Session() = default;

  [[nodiscard]] Screen screen() const noexcept { return screen_; }
  [[nodiscard]] const Paired& paired() const noexcept { return paired_; }
  [[nodiscard]] Liveness& liveness() noexcept { return liveness_; }
  [[nodiscard]] const Liveness& liveness() const noexcept { return liveness_; }

  /// Did what it says now, having heard of `seen`, set out within the last second, and is it there?
  [[nodiscard]] virtual bool fresh(std::uint32_t seen, Instant now) const noexcept = 0;

  virtual void hear(std::string_view message, bool binary, Instant now) = 0;
  /// A ping has been written to its last byte.
  virtual void pinged(std::uint32_t number, Instant now) = 0;
  /// It has answered the newest ping.
  virtual void alive(std::uint32_t number, Instant now) = 0;
  virtual void answered(std::uint32_t number, Verdict verdict) = 0;
  /// What is to be written next, when the connection takes more.
  [[nodiscard]] virtual std::optional<Frame> next(Instant now) = 0;
  /// What next() gave last has been written to its last byte.
  virtual void written(Instant now) = 0;
  /// It does not read: more answers wait for it than it may leave unread.
  [[nodiscard]] virtual bool overfull() const noexcept = 0;

 private:
  Screen screen_;
  Paired paired_;
  Liveness liveness_;
};

}  // namespace ivo::firmware::web
