#include "drivers/sim/object_dictionary.hpp"

#include <algorithm>

#include "config/base/contract.hpp"
#include "drivers/canopen/sdo_frame.hpp"

namespace ivo::drivers {
namespace {

std::uint32_t key(ObjectAddress address) noexcept { return std::uint32_t{address.index} << 8 | address.sub; }

}  // namespace

std::int64_t number_of(const ObjectEntry& entry, std::uint32_t value) noexcept {
  value = low_bytes(value, entry.bytes);
  if (!entry.is_signed) {
    return value;
  }
  const int unused = 64 - 8 * entry.bytes;
  return static_cast<std::int64_t>(std::uint64_t{value} << unused) >> unused;
}

bool ObjectDictionary::add(ObjectEntry entry) noexcept {
  IVO_CONTRACT(entries_.empty() || key(entries_.back().address) < key(entry.address));
  entry.default_value = low_bytes(entry.default_value, entry.bytes);
  entry.value = entry.default_value;
  return entries_.push_back(entry);
}

bool ObjectDictionary::add_long(ObjectEntry entry, std::span<const std::uint8_t> content) noexcept {
  if (contents_.full() || entries_.full()) {
    return false;
  }
  Content kept;
  kept.size = static_cast<std::uint8_t>(std::min(content.size(), kLongBytes));
  std::copy_n(content.begin(), kept.size, kept.bytes.begin());
  entry.long_slot = static_cast<std::uint8_t>(contents_.size());
  entry.bytes = 0;
  entry.into_rpdo = entry.into_tpdo = false;
  return contents_.push_back(kept) && shipped_.push_back(kept) && add(entry);
}

void ObjectDictionary::reset(std::uint16_t first, std::uint16_t last) noexcept {
  for (ObjectEntry& entry : entries_) {
    if (entry.address.index < first || entry.address.index > last) {
      continue;
    }
    entry.value = entry.default_value;
    if (entry.is_long()) {
      contents_[entry.long_slot] = shipped_[entry.long_slot];
    }
  }
}

ObjectEntry* ObjectDictionary::entry_at(ObjectAddress address) noexcept {
  auto* const at = std::lower_bound(entries_.begin(), entries_.end(), address,
                                    [](const ObjectEntry& e, ObjectAddress a) { return key(e.address) < key(a); });
  return at != entries_.end() && at->address == address ? at : nullptr;
}

const ObjectEntry* ObjectDictionary::find(ObjectAddress address) const noexcept {
  const auto* const at =
      std::lower_bound(entries_.begin(), entries_.end(), address,
                       [](const ObjectEntry& e, ObjectAddress a) { return key(e.address) < key(a); });
  return at != entries_.end() && at->address == address ? at : nullptr;
}

SdoAbort ObjectDictionary::why_missing(ObjectAddress address) const noexcept {
  const bool known = std::any_of(entries_.begin(), entries_.end(),
                                 [&](const ObjectEntry& entry) { return entry.address.index == address.index; });
  return known ? SdoAbort::kNoSubIndex : SdoAbort::kNoObject;
}

std::uint32_t ObjectDictionary::get(ObjectAddress address) const noexcept {
  const ObjectEntry* const entry = find(address);
  IVO_CONTRACT(entry != nullptr);
  return entry->value;
}

std::uint32_t ObjectDictionary::value_or(ObjectAddress address, std::uint32_t fallback) const noexcept {
  const ObjectEntry* const entry = find(address);
  return entry != nullptr ? entry->value : fallback;
}

void ObjectDictionary::set(ObjectAddress address, std::uint32_t value) noexcept {
  if (ObjectEntry* const entry = entry_at(address)) {
    entry->value = low_bytes(value, entry->bytes);
  }
}

void ObjectDictionary::set_default(ObjectAddress address, std::uint32_t value) noexcept {
  if (ObjectEntry* const entry = entry_at(address)) {
    entry->default_value = entry->value = low_bytes(value, entry->bytes);
  }
}

std::span<const std::uint8_t> ObjectDictionary::content(const ObjectEntry& entry) const noexcept {
  const Content& content = contents_[entry.long_slot];
  return {content.bytes.data(), content.size};
}

void ObjectDictionary::set_content(ObjectAddress address, std::span<const std::uint8_t> content) noexcept {
  const ObjectEntry* const entry = find(address);
  IVO_CONTRACT(entry != nullptr && entry->is_long() && content.size() <= kLongBytes);
  Content& kept = contents_[entry->long_slot];
  kept.size = static_cast<std::uint8_t>(content.size());
  std::copy(content.begin(), content.end(), kept.bytes.begin());
}

}  // namespace ivo::drivers
