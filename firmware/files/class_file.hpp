// Class tables: which colour of an image means which of the 14 classes, and what the class means.
#pragma once

#include <array>
#include <string>

#include "config/base/result.hpp"
#include "config/semantic_class.hpp"

namespace ivo::firmware {

struct ClassFile {
  ClassTable classes{};
  std::array<bool, kClasses> listed{};  ///< may occur in an image; the others keep the built-in properties
};

/// The built-in table, every class listed.
[[nodiscard]] ClassFile built_in_classes();

/// [[class]] entries: name, colour ([r, g, b] or "#rrggbb"), optional obstacle, occluder, restricted = ["robot",
/// "person"]; what is left out is as built in. Refuses a class twice and two classes of one colour.
[[nodiscard]] Result<ClassFile> read_classes(const std::string& path);

/// "#d6d2ca"
[[nodiscard]] std::string hex(Colour colour);

}  // namespace ivo::firmware
