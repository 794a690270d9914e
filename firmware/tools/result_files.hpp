// Where commands that move nothing put their results.
#pragma once

#include <initializer_list>
#include <string>

#include "config/base/result.hpp"

namespace ivo::firmware {

/// Makes the folder, and tries whether files of these names could be put into it: before the work, not after it.
[[nodiscard]] Result<void> open_folder(const std::string& folder, std::initializer_list<const char*> names);

/// Writes a file and says so; false when it could not be made or written, which is then said. As write_file.
[[nodiscard]] bool keep(const std::string& path, const Result<std::string>& contents);

}  // namespace ivo::firmware
