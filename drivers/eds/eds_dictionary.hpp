// The object dictionary that an EDS describes, as one fixed table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "config/base/static_vector.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/eds/data_type.hpp"

namespace ivo::drivers {

/// As an EDS has it (CiA 306-1, 4.6.2). The last two are read and written by SDO; by PDO only one way.
enum class EdsAccess : std::uint8_t { kReadOnly, kWriteOnly, kReadWrite, kConst, kReadWriteTpdo, kReadWriteRpdo };

[[nodiscard]] constexpr bool readable(EdsAccess access) noexcept { return access != EdsAccess::kWriteOnly; }
[[nodiscard]] constexpr bool writable(EdsAccess access) noexcept {
  return access != EdsAccess::kReadOnly && access != EdsAccess::kConst;
}

/// A value of the EDS: a whole number in two's complement of 64 bits, or the bits of a REAL32 or REAL64.
struct EdsValue {
  bool given = false;
  bool plus_node = false;  ///< $NODEID is added to it
  std::uint64_t bits = 0;

  [[nodiscard]] constexpr std::uint64_t at(std::uint8_t node_id) const noexcept {
    return bits + (plus_node ? node_id : 0U);
  }
};

struct EdsObject {
  ObjectAddress address;
  DataType type = DataType::kNone;
  EdsAccess access = EdsAccess::kReadOnly;
  bool mappable = false;
  std::uint8_t bytes = 0;  ///< by SDO; 0 for a string, a domain and a type that CiA 301 does not define
  EdsValue power_on;       ///< DefaultValue; in a DCF ParameterValue, where there is one
  EdsValue low;            ///< LowLimit
  EdsValue high;           ///< HighLimit
  std::uint32_t line = 0;  ///< of its section
  std::uint32_t name = 0;  ///< EdsDictionary::name_of
  std::uint32_t text = 0;  ///< EdsDictionary::text_of
  std::uint8_t name_bytes = 0;
  std::uint8_t text_bytes = 0;

  [[nodiscard]] std::uint8_t bits() const noexcept {  ///< in a PDO
    return static_cast<std::uint8_t>(type == DataType::kBoolean ? 1 : bytes * 8);
  }
  /// May be mapped into an RPDO (`received`) or a TPDO.
  [[nodiscard]] bool mappable_into(bool received) const noexcept;
};

/// [DeviceInfo]; 0 for what is not there.
struct EdsDevice {
  std::uint32_t vendor_number = 0;
  std::uint32_t product_number = 0;
  std::uint32_t revision_number = 0;
};

/// Made by read_eds. About half a megabyte: for start-up, in static memory or on the heap of whoever reads.
class EdsDictionary {
 public:
  static constexpr std::size_t kObjects = 4096;
  static constexpr std::size_t kTextBytes = 131'072;
  static constexpr std::size_t kStringBytes = 64;  ///< kept of one name or one string

  void clear() noexcept;

  /// One entry for each sub-index (of a variable: sub-index 0), by address.
  [[nodiscard]] std::span<const EdsObject> objects() const noexcept { return objects_.span(); }
  [[nodiscard]] const EdsObject* find(ObjectAddress address) const noexcept;
  [[nodiscard]] bool has_index(std::uint16_t index) const noexcept;
  [[nodiscard]] const EdsDevice& device() const noexcept { return device_; }
  /// [DummyUsage]: an entry of that data type may be mapped to leave room in a PDO.
  [[nodiscard]] bool dummy(DataType type) const noexcept;

  [[nodiscard]] std::string_view vendor_name() const noexcept { return part(vendor_name_, vendor_name_bytes_); }
  [[nodiscard]] std::string_view product_name() const noexcept { return part(product_name_, product_name_bytes_); }
  /// ParameterName.
  [[nodiscard]] std::string_view name_of(const EdsObject& object) const noexcept;
  /// The default of a string as the EDS writes it.
  [[nodiscard]] std::string_view text_of(const EdsObject& object) const noexcept;

 private:
  friend class EdsReader;
  struct Text {
    std::uint32_t at = 0;
    std::uint8_t bytes = 0;
    bool kept = false;
  };
  [[nodiscard]] Text keep(std::string_view text) noexcept;
  [[nodiscard]] std::string_view part(std::uint32_t at, std::size_t bytes) const noexcept {
    return {text_.data() + at, bytes};
  }

  StaticVector<EdsObject, kObjects> objects_;
  EdsDevice device_;
  std::uint32_t dummies_ = 0;  // bit n: data type n
  std::uint32_t vendor_name_ = 0;
  std::uint32_t product_name_ = 0;
  std::uint8_t vendor_name_bytes_ = 0;
  std::uint8_t product_name_bytes_ = 0;
  std::array<char, kTextBytes> text_{};
  std::size_t text_used_ = 0;
};

}  // namespace ivo::drivers
