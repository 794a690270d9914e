// JSON schemas of the log's channels. Those named foxglove.* are Foxglove's own, which it draws.
#pragma once

#include <span>
#include <string>

#include "firmware/record/mcap_file.hpp"

namespace ivo::firmware::mcap_schemas {

[[nodiscard]] McapFile::Schema pose_in_frame();
[[nodiscard]] McapFile::Schema poses_in_frame();
[[nodiscard]] McapFile::Schema frame_transform();
[[nodiscard]] McapFile::Schema grid();
[[nodiscard]] McapFile::Schema log();
[[nodiscard]] McapFile::Schema command();
[[nodiscard]] McapFile::Schema wheels(std::span<const std::string> names);
[[nodiscard]] McapFile::Schema timing(std::span<const std::string> phases);

}  // namespace ivo::firmware::mcap_schemas
