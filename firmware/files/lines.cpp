#include "firmware/files/lines.hpp"

#include <algorithm>
#include <utility>

namespace ivo::firmware {

Lines::Lines(std::string path, std::map<std::string, int, std::less<>> lines)
    : path_(std::move(path)), lines_(std::move(lines)) {}

int Lines::line_of(std::string_view key_path) const {
  for (;;) {
    const auto found = lines_.find(key_path);
    if (found != lines_.end()) {
      return found->second;
    }
    const std::size_t end = key_path.find_last_of(".[");
    if (end == std::string_view::npos) {
      return 1;
    }
    key_path = key_path.substr(0, end);
  }
}

Error Lines::at(std::string_view key_path, std::string_view what) const {
  std::string message = path_ + ":" + std::to_string(line_of(key_path)) + ": ";
  if (!key_path.empty()) {
    message.append(key_path).append(": ");
  }
  message.append(what);
  // Keys and texts quoted from a file may hold line breaks; a complaint is one line.
  std::replace_if(
      message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return Error{message};
}

}  // namespace ivo::firmware
