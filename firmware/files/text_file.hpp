// Whole files and the paths between them. Start-up and shut-down only: every call may wait for the disk.
#pragma once

#include <string>
#include <string_view>

#include "config/base/result.hpp"

namespace ivo::firmware {

/// The whole file. Refuses what cannot be read and what is longer than 256 MiB, in one line that names the path.
[[nodiscard]] Result<std::string> read_file(const std::string& path);

/// Puts `contents` at `path` at once: a reader sees the old file or the new one, never a part, also after a power cut.
/// Written beside the target, synced, renamed; on failure the target is as it was and nothing is left behind.
/// The folder must exist (make_folder), and what is there by that name must be a file: a device stays what it is.
[[nodiscard]] Result<void> write_file(const std::string& path, std::string_view contents);
/// The same, for its owner's eyes alone.
[[nodiscard]] Result<void> write_private_file(const std::string& path, std::string_view contents);

/// Whether write_file could put a file at `path` now; tried beside it, and nothing stays.
[[nodiscard]] Result<void> check_writable(const std::string& path);

/// The folder and those above it; a folder that is already there is fine.
[[nodiscard]] Result<void> make_folder(const std::string& path);

/// `relative` as written in `file`: relative to the folder of `file`. An absolute path stays what it is.
[[nodiscard]] std::string beside(const std::string& file, const std::string& relative);

}  // namespace ivo::firmware
