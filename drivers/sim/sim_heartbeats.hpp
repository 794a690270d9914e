// The nodes that a simulated device watches by their heartbeats (1016h).
#pragma once

#include <cstdint>
#include <optional>

#include "config/base/static_vector.hpp"
#include "drivers/canopen/heartbeat.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/sim/object_dictionary.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

class SimHeartbeats {
 public:
  static constexpr std::size_t kWatched = 8;

  /// Why `value` cannot be written to 1016h:`sub`: another entry has its node already.
  [[nodiscard]] static std::optional<SdoAbort> refusal(const ObjectDictionary& objects, std::uint8_t sub,
                                                       std::uint32_t value) noexcept;
  /// 1016h was written: what it watches begins anew with the first heartbeat.
  void configure(const ObjectDictionary& objects) noexcept;
  void on_frame(const hal::CanFrame& frame, Instant now) noexcept;
  /// A node was lost since the last call.
  [[nodiscard]] bool newly_lost(Instant now) noexcept;
  /// Nothing that was lost has stayed so.
  [[nodiscard]] bool all_back() const noexcept;

 private:
  struct Watched {
    std::uint8_t node_id = 0;
    HeartbeatConsumer consumer{Duration::zero()};
    bool lost = false;
  };
  StaticVector<Watched, kWatched> watched_;
};

}  // namespace ivo::drivers
