#include "firmware/tools/doctor/kernel_command_line.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr const char* kGrub = "/etc/default/grub";

}  // namespace

std::string kernel_argument(const MachineFiles& files, const std::string& key) {
  std::string value;
  for (const std::string& word : words_of(files.text("/proc/cmdline").value_or(""))) {
    if (word.starts_with(key + "=")) {
      value = word.substr(key.size() + 1);
    }
  }
  return value;
}

std::string add_to_command_line(const MachineFiles& files, const std::string& arguments) {
  return files.there(kGrub)
             ? "add " + arguments + " to GRUB_CMDLINE_LINUX in " + kGrub + ", then update-grub and reboot"
             : "add " + arguments + " to the kernel's command line where the boot loader has it, then reboot";
}

}  // namespace ivo::firmware::doctor
