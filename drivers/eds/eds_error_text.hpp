// The sentence of an EDS error.
#pragma once

#include <string>

#include "drivers/eds/eds_error.hpp"

namespace ivo::drivers {

/// "[1018sub1] DefaultValue: "0x1FF" does not fit UNSIGNED8; expected 0 to 255", without file and line. Bytes that are
/// no printable ASCII are shown as ?.
[[nodiscard]] std::string describe(const EdsError& error);

}  // namespace ivo::drivers
