#include "drivers/sim/sim_heartbeats.hpp"

#include <algorithm>
#include <chrono>

#include "drivers/canopen/communication_objects.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint8_t kHighestNodeId = 127;

std::uint8_t node_of(std::uint32_t entry) noexcept { return static_cast<std::uint8_t>(entry >> 16); }

/// An entry without a time or a node is not used (CiA 301, 7.5.2.17).
bool used(std::uint32_t entry) noexcept {
  return (entry & 0xFFFF) != 0 && node_of(entry) != 0 && node_of(entry) <= kHighestNodeId;
}

}  // namespace

std::optional<SdoAbort> SimHeartbeats::refusal(const ObjectDictionary& objects, std::uint8_t sub,
                                               std::uint32_t value) noexcept {
  for (std::uint8_t other = 1; other <= kWatched && used(value); ++other) {
    const std::uint32_t entry = objects.value_or({object::kConsumerHeartbeat.index, other}, 0);
    if (other != sub && used(entry) && node_of(entry) == node_of(value)) {
      return SdoAbort::kParameterIncompatible;
    }
  }
  return std::nullopt;
}

void SimHeartbeats::configure(const ObjectDictionary& objects) noexcept {
  watched_.clear();
  for (std::uint8_t sub = 1; sub <= kWatched; ++sub) {
    const std::uint32_t entry = objects.value_or({object::kConsumerHeartbeat.index, sub}, 0);
    if (used(entry)) {
      (void)watched_.push_back({node_of(entry), HeartbeatConsumer(std::chrono::milliseconds(entry & 0xFFFF)), false});
    }
  }
}

void SimHeartbeats::on_frame(const hal::CanFrame& frame, Instant now) noexcept {
  if (!parse_heartbeat(frame).has_value()) {
    return;
  }
  for (Watched& watched : watched_) {
    if (watched.node_id == cob_id::node_of(frame.id)) {
      watched.consumer.heard(now);
      watched.lost = false;
    }
  }
}

bool SimHeartbeats::newly_lost(Instant now) noexcept {
  bool any = false;
  for (Watched& watched : watched_) {
    if (watched.consumer.lost(now)) {
      watched.consumer.forget();
      watched.lost = any = true;
    }
  }
  return any;
}

bool SimHeartbeats::all_back() const noexcept {
  return std::none_of(watched_.begin(), watched_.end(), [](const Watched& watched) { return watched.lost; });
}

}  // namespace ivo::drivers
