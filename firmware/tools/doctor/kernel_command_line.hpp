// The arguments that a kernel was booted with.
#pragma once

#include <string>

#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

/// What `key=` is set to; empty where it is not.
[[nodiscard]] std::string kernel_argument(const MachineFiles& files, const std::string& key);

/// How they are set at the next boot, whichever else are set there: "add ARGUMENTS to GRUB_CMDLINE_LINUX in
/// /etc/default/grub, then update-grub and reboot", or without GRUB "add ARGUMENTS to the kernel's command line ...".
[[nodiscard]] std::string add_to_command_line(const MachineFiles& files, const std::string& arguments);

}  // namespace ivo::firmware::doctor
