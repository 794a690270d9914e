// One section of an EDS as an object: its fields, checked and converted.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/eds/eds_dictionary.hpp"
#include "drivers/eds/eds_error.hpp"
#include "drivers/eds/eds_section.hpp"

namespace ivo::drivers {

/// ObjectType (CiA 301, table 42).
enum class EdsObjectType : std::uint8_t {
  kNull = 0,
  kDomain = 2,
  kDefType = 5,
  kDefStruct = 6,
  kVariable = 7,
  kArray = 8,
  kRecord = 9,
};

/// The section's fields become an object or an error; the error's section is for the caller to fill in.
class EdsEntryReader {
 public:
  explicit EdsEntryReader(const EdsFields& fields, std::uint32_t section_line) noexcept
      : fields_(fields), section_line_(section_line) {}

  /// ObjectType; a variable where there is none.
  [[nodiscard]] EdsObjectType object_type() noexcept;
  /// A whole number up to `most`; `fallback` where there is none.
  [[nodiscard]] std::uint64_t number(EdsKey key, std::uint64_t most, std::uint64_t fallback = 0) noexcept;
  /// Complains when there is none.
  void require(EdsKey key) noexcept;
  /// Type, access, mapping and values; name and text are not set.
  [[nodiscard]] EdsObject entry(ObjectAddress address, bool domain) noexcept;

  /// The first that was found.
  [[nodiscard]] const std::optional<EdsError>& error() const noexcept { return error_; }

 private:
  void complain(EdsProblem problem, EdsKey key, DataType type = DataType::kNone) noexcept;
  [[nodiscard]] EdsAccess access() noexcept;
  [[nodiscard]] EdsValue value(EdsKey key, DataType type) noexcept;

  const EdsFields& fields_;
  std::uint32_t section_line_;
  std::optional<EdsError> error_;
};

}  // namespace ivo::drivers
