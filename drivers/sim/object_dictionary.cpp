#include "drivers/sim/object_dictionary.hpp"

#include <algorithm>

#include "config/base/contract.hpp"
#include "drivers/canopen/sdo_frame.hpp"

namespace ivo::drivers {

void ObjectDictionary::add(ObjectEntry entry) noexcept {
  entry.value = entry.default_value;
  IVO_CONTRACT(find(entry.address) == nullptr && entries_.push_back(entry));
}

void ObjectDictionary::reset(std::uint16_t first, std::uint16_t last) noexcept {
  for (ObjectEntry& entry : entries_) {
    if (entry.address.index >= first && entry.address.index <= last) {
      entry.value = entry.default_value;
    }
  }
}

const ObjectEntry* ObjectDictionary::find(ObjectAddress address) const noexcept {
  const auto* const entry = std::find_if(entries_.begin(), entries_.end(),
                                         [&](const ObjectEntry& candidate) { return candidate.address == address; });
  return entry == entries_.end() ? nullptr : entry;
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

void ObjectDictionary::set(ObjectAddress address, std::uint32_t value) noexcept {
  const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const ObjectEntry& candidate) { return candidate.address == address; });
  IVO_CONTRACT(entry != entries_.end());
  entry->value = low_bytes(value, entry->bytes);
}

}  // namespace ivo::drivers
