// A device's object dictionary as a small fixed table of objects of up to four bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/base/static_vector.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"

namespace ivo::drivers {

enum class ObjectAccess : std::uint8_t { kReadOnly, kReadWrite };

struct ObjectEntry {
  ObjectAddress address;
  std::uint8_t bytes = 4;  ///< 1, 2 or 4
  ObjectAccess access = ObjectAccess::kReadOnly;
  bool mappable = false;            ///< into a PDO
  std::uint32_t default_value = 0;  ///< after reset; signed values in two's complement of `bytes` bytes
  std::uint32_t value = 0;
};

class ObjectDictionary {
 public:
  static constexpr std::size_t kEntries = 64;

  /// Adds an entry with its default value. Programmer's contract: there is room and the address is new.
  void add(ObjectEntry entry) noexcept;
  /// All objects from `first` to `last` index back to their defaults.
  void reset(std::uint16_t first, std::uint16_t last) noexcept;

  [[nodiscard]] const ObjectEntry* find(ObjectAddress address) const noexcept;
  /// Why nothing can be read or written at `address`: no such object, or no such sub-index of it.
  [[nodiscard]] SdoAbort why_missing(ObjectAddress address) const noexcept;

  /// Value of an object that exists (contract).
  [[nodiscard]] std::uint32_t get(ObjectAddress address) const noexcept;
  /// Sets an object that exists (contract), by the device itself: access is not looked at.
  void set(ObjectAddress address, std::uint32_t value) noexcept;

 private:
  StaticVector<ObjectEntry, kEntries> entries_;
};

}  // namespace ivo::drivers
