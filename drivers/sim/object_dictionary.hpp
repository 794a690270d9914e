// A device's object dictionary as a fixed table: numbers of up to four bytes, and a few longer objects.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "config/base/static_vector.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"

namespace ivo::drivers {

struct ObjectEntry {
  static constexpr std::uint8_t kNotLong = 0xFF;

  ObjectAddress address;
  std::uint8_t bytes = 4;  ///< 1 to 4; of a long object: as many as it has now
  bool readable = true;
  bool writable = false;
  bool into_rpdo = false;  ///< may be mapped
  bool into_tpdo = false;
  bool is_signed = false;
  std::uint8_t long_slot = kNotLong;
  std::int64_t low = std::numeric_limits<std::int64_t>::min();  ///< what may be written
  std::int64_t high = std::numeric_limits<std::int64_t>::max();
  std::uint32_t default_value = 0;  ///< after reset; signed values in two's complement of `bytes` bytes
  std::uint32_t value = 0;

  [[nodiscard]] bool is_long() const noexcept { return long_slot != kNotLong; }
};

/// `value`, the lowest `bytes` of it, as a number with its sign.
[[nodiscard]] std::int64_t number_of(const ObjectEntry& entry, std::uint32_t value) noexcept;

class ObjectDictionary {
 public:
  static constexpr std::size_t kEntries = 1024;
  static constexpr std::size_t kLongObjects = 32;
  static constexpr std::size_t kLongBytes = 64;  ///< of one

  /// Adds an entry with its default value, at the end: addresses go up. False when there is no room.
  [[nodiscard]] bool add(ObjectEntry entry) noexcept;
  [[nodiscard]] bool add_long(ObjectEntry entry, std::span<const std::uint8_t> content) noexcept;
  /// All objects from `first` to `last` index back to their defaults.
  void reset(std::uint16_t first, std::uint16_t last) noexcept;

  [[nodiscard]] const ObjectEntry* find(ObjectAddress address) const noexcept;
  /// Why nothing can be read or written at `address`: no such object, or no such sub-index of it.
  [[nodiscard]] SdoAbort why_missing(ObjectAddress address) const noexcept;

  /// Value of an object that exists (contract).
  [[nodiscard]] std::uint32_t get(ObjectAddress address) const noexcept;
  /// Value of an object, or what stands for it in a device that does not have it.
  [[nodiscard]] std::uint32_t value_or(ObjectAddress address, std::uint32_t fallback) const noexcept;
  /// Sets an object if it exists, by the device itself: access and limits are not looked at.
  void set(ObjectAddress address, std::uint32_t value) noexcept;
  /// Makes `value` an object's default, which it has after a reset too; if it exists.
  void set_default(ObjectAddress address, std::uint32_t value) noexcept;

  [[nodiscard]] std::span<const std::uint8_t> content(const ObjectEntry& entry) const noexcept;  ///< of a long object
  void set_content(ObjectAddress address, std::span<const std::uint8_t> content) noexcept;

 private:
  struct Content {
    std::array<std::uint8_t, kLongBytes> bytes{};
    std::uint8_t size = 0;
  };
  [[nodiscard]] ObjectEntry* entry_at(ObjectAddress address) noexcept;

  StaticVector<ObjectEntry, kEntries> entries_;
  StaticVector<Content, kLongObjects> contents_;
  StaticVector<Content, kLongObjects> shipped_;  // contents_ after a reset
};

}  // namespace ivo::drivers
