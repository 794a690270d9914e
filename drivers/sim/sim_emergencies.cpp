#include "drivers/sim/sim_emergencies.hpp"

#include <algorithm>
#include <chrono>
#include <span>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/little_endian.hpp"
#include "drivers/sim/sim_objects.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint8_t kGeneric = 0x01;

/// The bit of 1001h for an error code's class (CiA 301, table 26).
std::uint8_t register_bits(std::uint16_t code) noexcept {
  switch (code >> 12) {
    case 0x2:
      return kGeneric | 0x02;
    case 0x3:
      return kGeneric | 0x04;
    case 0x4:
      return kGeneric | 0x08;
    case 0x8:
      return static_cast<std::uint8_t>(kGeneric | (code < 0x8300 ? 0x10 : 0x20));
    case 0x7:
      return kGeneric | 0x20;
    case 0xF:
      return kGeneric | 0x80;
    default:
      return kGeneric;
  }
}

/// The newest error is at sub-index 1; sub-index 0 counts them.
void remember(std::uint16_t code, ObjectDictionary& objects) noexcept {
  const std::uint16_t history = sim_object::kErrorCount.index;
  std::uint32_t room = 0;
  while (room < 0xFE && objects.find({history, static_cast<std::uint8_t>(room + 1)}) != nullptr) {
    ++room;
  }
  for (std::uint32_t sub = room; sub > 1; --sub) {
    objects.set({history, static_cast<std::uint8_t>(sub)}, objects.get({history, static_cast<std::uint8_t>(sub - 1)}));
  }
  objects.set({history, 1}, code);
  objects.set(sim_object::kErrorCount, std::min(objects.value_or(sim_object::kErrorCount, 0) + 1, room));
}

}  // namespace

void SimEmergencies::raise(Source source, std::uint16_t code, const Vendor& vendor,
                           ObjectDictionary& objects) noexcept {
  if (codes_[index(source)] == code) {
    return;
  }
  codes_[index(source)] = code;
  refresh_register(objects);
  remember(code, objects);
  say(code, vendor, objects);
}

void SimEmergencies::clear(Source source, const Vendor& vendor, ObjectDictionary& objects) noexcept {
  if (!active(source)) {
    return;
  }
  codes_[index(source)] = 0;
  refresh_register(objects);
  if (std::all_of(codes_.begin(), codes_.end(), [](std::uint16_t code) { return code == 0; })) {
    say(0, vendor, objects);
  }
}

void SimEmergencies::refresh_register(ObjectDictionary& objects) const noexcept {
  std::uint8_t bits = 0;
  for (const std::uint16_t code : codes_) {
    bits = static_cast<std::uint8_t>(bits | (code != 0 ? register_bits(code) : 0));
  }
  objects.set(object::kErrorRegister, bits);
}

void SimEmergencies::say(std::uint16_t code, const Vendor& vendor, ObjectDictionary& objects) noexcept {
  hal::CanFrame frame{.id = 0, .size = 8, .data = {}};
  store(std::span(frame.data), code);
  frame.data[2] = static_cast<std::uint8_t>(objects.get(object::kErrorRegister));
  std::copy(vendor.begin(), vendor.end(), frame.data.begin() + 3);
  if (waiting_.full()) {
    std::copy(waiting_.begin() + 1, waiting_.end(), waiting_.begin());
    waiting_.pop_back();
  }
  (void)waiting_.push_back(frame);
}

std::optional<hal::CanFrame> SimEmergencies::next(Instant now, const ObjectDictionary& objects) noexcept {
  const auto inhibit = std::chrono::microseconds(100) * objects.value_or(sim_object::kEmcyInhibit, 0);
  if (waiting_.empty() || (last_.has_value() && now - *last_ < inhibit)) {
    return std::nullopt;
  }
  const std::uint32_t cob_id = objects.value_or(sim_object::kEmcyCobId, cob_id::kPdoInvalid);
  hal::CanFrame frame = waiting_[0];
  frame.id = static_cast<std::uint16_t>(cob_id & 0x7FF);
  std::copy(waiting_.begin() + 1, waiting_.end(), waiting_.begin());
  waiting_.pop_back();
  if ((cob_id & cob_id::kPdoInvalid) != 0) {
    return std::nullopt;
  }
  last_ = now;
  return frame;
}

}  // namespace ivo::drivers
