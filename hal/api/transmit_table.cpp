#include "hal/api/transmit_table.hpp"

#include <algorithm>

#include "config/base/contract.hpp"
#include "config/rates.hpp"

namespace ivo::hal {
namespace {

template <std::size_t N>
void erase(StaticVector<std::uint8_t, N>& list, std::uint8_t value) noexcept {
  const auto* const end = std::remove(list.begin(), list.end(), value);
  list.resize(static_cast<std::size_t>(end - list.begin()));
}

}  // namespace

TransmitTable::TransmitTable(const IdSet& echoed) noexcept : echoed_(echoed) {
  slot_of_.fill(kNone);
  for (std::size_t i = kSlots; i-- > 0;) {
    IVO_CONTRACT(free_.push_back(static_cast<std::uint8_t>(i)));
  }
}

std::span<const CanFrame> TransmitTable::offer(std::span<const CanFrame> given, Instant now) noexcept {
  drop_old(now);
  batch_.clear();
  taken_of_batch_ = 0;
  for (const CanFrame& frame : given) {
    take(frame, now);
  }
  given_in_batch_ = batch_.size();
  offer_leftovers();
  std::transform(batch_.begin(), batch_.end(), frames_.begin(), [](const Entry& entry) { return entry.frame; });
  return std::span(frames_).first(batch_.size());
}

void TransmitTable::take(const CanFrame& frame, Instant now) noexcept {
  IVO_CONTRACT(frame.id < 0x800 && frame.size <= frame.data.size());
  const Entry entry{.order = ++order_, .given_at = now, .frame = frame};
  const std::uint16_t key = key_of(frame);
  std::uint8_t index = slot_of_[key];
  if (index != kNone && slots_[index].waiting) {
    ++counters_.replaced;
    stop_waiting(index);
  }
  if (echoed(key)) {
    index = obtain(key);
    if (index == kNone) {
      ++counters_.dropped;
      return;
    }
    Slot& slot = slots_[index];
    if (!slot.in_flight && !slot.offered && batch_.push_back(entry)) {
      slot.offered = true;
      return;
    }
  } else if (batch_.push_back(entry)) {
    give_back_if_idle(slot_of_[key]);
    return;
  }
  wait(entry);
}

void TransmitTable::offer_leftovers() noexcept {
  for (std::size_t i = 0; i < waiting_.size();) {
    const std::uint8_t index = waiting_[i];
    Slot& slot = slots_[index];
    // What waits behind a frame of its own COB-ID waits on, whether that one is in flight or about to be.
    if (slot.in_flight || slot.offered || !batch_.push_back(slot.entry)) {
      ++i;
      continue;
    }
    slot.offered = true;
    slot.waiting = false;
    erase(waiting_, index);
  }
}

std::size_t TransmitTable::handed_over(std::size_t count, Instant now) noexcept {
  IVO_CONTRACT(count <= batch_.size());
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const std::uint16_t key = key_of(batch_[i].frame);
    if (const std::uint8_t index = slot_of_[key]; index != kNone) {
      slots_[index].offered = false;
    }
    if (i >= count) {
      wait(batch_[i]);
      continue;
    }
    ++counters_.handed_over;
    if (!echoed(key)) {
      ++counters_.confirmed;
      give_back_if_idle(slot_of_[key]);
      continue;
    }
    Slot& slot = slots_[slot_of_[key]];
    slot.in_flight = true;
    slot.handed_at = now;
    IVO_CONTRACT(in_flight_.push_back(slot_of_[key]));
  }
  taken_of_batch_ = count;
  return std::min(count, given_in_batch_);
}

void TransmitTable::echo(const CanFrame& frame, Instant now) noexcept {
  ++counters_.confirmed;
  last_echo_ = now;
  unconfirmed_ = false;
  const std::uint16_t key = key_of(frame);
  const std::uint8_t index = slot_of_[key];
  if (index == kNone || !slots_[index].in_flight) {
    return;  // given up before
  }
  const Instant handed_at = slots_[index].handed_at;
  land(index);
  give_up_overtaken(key, handed_at);
}

void TransmitTable::settle(Instant now) noexcept {
  for (const std::uint8_t index : in_flight_) {
    if (!unconfirmed_ && now - std::max(slots_[index].handed_at, last_echo_) >= rates::kTransmitTimeout) {
      unconfirmed_ = true;
      last_probe_ = now;
    }
  }
  if (unconfirmed_ && !in_flight_.empty() && now - last_probe_ >= kProbeEvery) {
    last_probe_ = now;
    land(*std::max_element(in_flight_.begin(), in_flight_.end(), [this](std::uint8_t a, std::uint8_t b) {
      return id_of(slots_[a].key) < id_of(slots_[b].key);
    }));
  }
}

void TransmitTable::forget() noexcept {
  taken_of_batch_ = 0;
  while (!waiting_.empty()) {
    ++counters_.dropped;
    const std::uint8_t index = waiting_.back();
    stop_waiting(index);
    give_back_if_idle(index);
  }
  while (!in_flight_.empty()) {
    land(in_flight_.back());
  }
  unconfirmed_ = false;
}

bool TransmitTable::just_handed_over(std::uint16_t id) const noexcept {
  const auto taken = just_handed_over();
  return std::any_of(taken.begin(), taken.end(), [id](const CanFrame& frame) { return frame.id == id; });
}

// NMT commands share one COB-ID: two nodes' must not replace each other.
std::uint16_t TransmitTable::key_of(const CanFrame& frame) noexcept {
  const unsigned node = frame.size >= 2 ? frame.data[1] : 0U;
  return frame.id != 0 ? frame.id : static_cast<std::uint16_t>(0x800 + node);
}

std::uint8_t TransmitTable::obtain(std::uint16_t key) noexcept {
  if (slot_of_[key] == kNone && !free_.empty()) {
    slot_of_[key] = free_.back();
    free_.pop_back();
    slots_[slot_of_[key]] = {};
    slots_[slot_of_[key]].key = key;
  }
  return slot_of_[key];
}

void TransmitTable::give_back_if_idle(std::uint8_t index) noexcept {
  if (index == kNone || slots_[index].waiting || slots_[index].offered || slots_[index].in_flight) {
    return;
  }
  slot_of_[slots_[index].key] = kNone;
  IVO_CONTRACT(free_.push_back(index));
}

void TransmitTable::wait(const Entry& entry) noexcept {
  const std::uint8_t index = obtain(key_of(entry.frame));
  if (index == kNone) {
    ++counters_.dropped;
    return;
  }
  Slot& slot = slots_[index];
  if (slot.waiting) {
    ++counters_.replaced;
    if (slot.entry.order > entry.order) {
      return;
    }
    stop_waiting(index);
  }
  slot.entry = entry;
  slot.waiting = true;
  IVO_CONTRACT(waiting_.push_back(index));
}

void TransmitTable::stop_waiting(std::uint8_t index) noexcept {
  slots_[index].waiting = false;
  erase(waiting_, index);
}

void TransmitTable::drop_old(Instant now) noexcept {
  for (std::size_t i = 0; i < waiting_.size();) {
    const std::uint8_t index = waiting_[i];
    if (now - slots_[index].entry.given_at <= rates::kTransmitAge) {
      ++i;
      continue;
    }
    ++counters_.dropped;
    stop_waiting(index);
    give_back_if_idle(index);
  }
}

void TransmitTable::land(std::uint8_t index) noexcept {
  slots_[index].in_flight = false;
  erase(in_flight_, index);
  give_back_if_idle(index);
}

// An echo can be lost, as when the receive queue overflowed; its COB-ID must not be blocked for ever. What was handed
// over well before a less urgent frame that has left is gone too, in a queue as by priority. A more urgent frame may
// have overtaken it, but not for long on a bus that works.
void TransmitTable::give_up_overtaken(std::uint16_t key, Instant handed_at) noexcept {
  for (std::size_t i = in_flight_.size(); i-- > 0;) {
    const std::uint8_t index = in_flight_[i];
    const bool less_urgent_left = id_of(key) > id_of(slots_[index].key);
    const Duration earlier = handed_at - slots_[index].handed_at;
    if (earlier >= (less_urgent_left ? rates::kTransmitAge : rates::kTransmitTimeout)) {
      ++counters_.echo_lost;
      land(index);
    }
  }
}

}  // namespace ivo::hal
