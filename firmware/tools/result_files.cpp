#include "firmware/tools/result_files.hpp"

#include "firmware/files/text_file.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {

Result<void> open_folder(const std::string& folder, std::initializer_list<const char*> names) {
  if (Result<void> made = make_folder(folder); !made) {
    return made;
  }
  for (const char* const name : names) {
    if (Result<void> writable = check_writable(folder + "/" + name); !writable) {
      return writable;
    }
  }
  return {};
}

bool keep(const std::string& path, const Result<std::string>& contents) {
  if (!contents) {
    complain(contents.error());
    return false;
  }
  if (const Result<void> written = write_file(path, contents.value()); !written) {
    complain(written.error());
    return false;
  }
  say("wrote", path);
  return true;
}

}  // namespace ivo::firmware
