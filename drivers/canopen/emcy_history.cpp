#include "drivers/canopen/emcy_history.hpp"

#include <algorithm>

#include "config/base/contract.hpp"

namespace ivo::drivers {

bool EmcyHistory::add(const Emergency& emergency, Instant now) noexcept {
  ++total_;
  auto* const known = std::find_if(entries_.begin(), entries_.end(), [&](const EmcyEntry& entry) {
    return entry.emergency.code == emergency.code && now - entry.last <= kTogether;
  });
  if (known != entries_.end()) {
    known->emergency = emergency;
    known->last = now;
    ++known->count;
    return false;
  }
  if (now - window_ > kTogether) {
    window_ = now;
    begun_ = 0;
  }
  if (begun_ == kNewEntries) {
    ++forgotten_;
    return false;
  }
  ++begun_;
  if (entries_.full()) {
    forgotten_ += entries_[0].count;
    std::move(entries_.begin() + 1, entries_.end(), entries_.begin());
    entries_.pop_back();
  }
  IVO_CONTRACT(entries_.push_back({.emergency = emergency, .first = now, .last = now, .count = 1}));
  return true;
}

}  // namespace ivo::drivers
