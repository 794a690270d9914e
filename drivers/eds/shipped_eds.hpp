// The EDS files of config/eds that are compiled in, so that a simulated drive needs no file.
#pragma once

#include <string_view>

#include "drivers/eds/eds_dictionary.hpp"

namespace ivo::drivers {

/// The text of config/eds/ivo_drive.eds: an IVO-class wheel drive.
[[nodiscard]] std::string_view ivo_drive_eds_text() noexcept;
/// The text of config/eds/fixed_mapping_drive.eds: one whose PDO mappings cannot be written.
[[nodiscard]] std::string_view fixed_mapping_drive_eds_text() noexcept;

/// The same, read: at the first call, which is for start-up.
[[nodiscard]] const EdsDictionary& ivo_drive_eds() noexcept;
[[nodiscard]] const EdsDictionary& fixed_mapping_drive_eds() noexcept;

}  // namespace ivo::drivers
