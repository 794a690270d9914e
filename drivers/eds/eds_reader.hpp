// Reads an EDS or DCF (CiA 306-1): what objects a device has, of which type and with which limits.
#pragma once

#include <optional>
#include <string_view>

#include "drivers/eds/eds_dictionary.hpp"
#include "drivers/eds/eds_error.hpp"

namespace ivo::drivers {

/// Fills `into`; none when all was right, else `into` is of no use. Any bytes may be in `text`.
///
/// Read: [DeviceInfo], [DummyUsage], the three lists of objects, objects and their sub-indices, CompactSubObj. What a
/// list names must have a section; SubNumber and SupportedObjects must be as many as there are. Sections and keys that
/// are not known are passed over. Refused by name: tables [xxxxValue] of a DCF. Cost: n log n in the number of objects.
[[nodiscard]] std::optional<EdsError> read_eds(std::string_view text, EdsDictionary& into) noexcept;

}  // namespace ivo::drivers
