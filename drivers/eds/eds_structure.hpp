// Whether the sections of an EDS fit together: what is listed is there, what has sub-indices has as many as it says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "config/base/static_vector.hpp"
#include "drivers/eds/eds_dictionary.hpp"
#include "drivers/eds/eds_entry.hpp"
#include "drivers/eds/eds_error.hpp"

namespace ivo::drivers {

/// The section of an object itself, without its sub-indices.
struct EdsHead {
  std::uint16_t index = 0;
  EdsObjectType type = EdsObjectType::kVariable;
  std::uint16_t subs = 0;    ///< SubNumber
  std::uint8_t compact = 0;  ///< CompactSubObj
  std::uint32_t line = 0;
};

/// One line of a list of objects.
struct EdsListed {
  std::uint16_t index = 0;
  std::uint32_t line = 0;
};

/// In this order.
[[nodiscard]] bool before(const EdsObject& a, const EdsObject& b) noexcept;

class EdsStructure {
 public:
  /// False when there is no room.
  [[nodiscard]] bool add(const EdsHead& head) noexcept { return heads_.push_back(head); }
  [[nodiscard]] bool list(const EdsListed& listed) noexcept { return listed_.push_back(listed); }
  [[nodiscard]] std::size_t listed() const noexcept { return listed_.size(); }

  /// What is wrong with all that was read; `objects` in order. Sorts what was added.
  [[nodiscard]] std::optional<EdsError> error(std::span<const EdsObject> objects) noexcept;

 private:
  using Fault = std::optional<EdsError>;
  [[nodiscard]] Fault duplicate_head() const noexcept;
  [[nodiscard]] Fault wrong_list() const noexcept;

  StaticVector<EdsListed, EdsDictionary::kObjects> listed_;
  StaticVector<EdsHead, EdsDictionary::kObjects> heads_;
};

}  // namespace ivo::drivers
