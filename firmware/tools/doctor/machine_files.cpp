#include "firmware/tools/doctor/machine_files.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace ivo::firmware::doctor {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
constexpr const char* kWhiteSpace = " \t\r\n";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kWhiteSpace);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kWhiteSpace) - first + 1);
}

}  // namespace

std::optional<std::string> MachineFiles::bytes(const std::string& path) const {
  std::error_code unknown;
  if (std::filesystem::is_directory(root_ + path, unknown)) {
    return std::nullopt;
  }
  std::ifstream file(root_ + path, std::ios::binary);
  if (!file) {
    return std::nullopt;
  }
  std::string contents(kMostBytes, '\0');
  file.read(contents.data(), static_cast<std::streamsize>(contents.size()));
  if (file.bad()) {
    return std::nullopt;
  }
  contents.resize(static_cast<std::size_t>(file.gcount()));
  return contents;
}

std::optional<std::string> MachineFiles::text(const std::string& path) const {
  const std::optional<std::string> contents = bytes(path);
  return contents ? std::optional(trimmed(*contents)) : std::nullopt;
}

std::optional<std::int64_t> MachineFiles::number(const std::string& path) const {
  const std::optional<std::string> contents = text(path);
  return contents ? whole_number(*contents) : std::nullopt;
}

std::vector<std::string> MachineFiles::lines(const std::string& path) const {
  std::vector<std::string> all;
  std::istringstream contents(text(path).value_or(""));
  for (std::string line; std::getline(contents, line);) {
    all.push_back(trimmed(line));
  }
  return all;
}

std::vector<std::string> MachineFiles::names(const std::string& folder) const {
  std::vector<std::string> all;
  std::error_code unknown;
  std::filesystem::directory_iterator next(root_ + folder, unknown);
  for (; !unknown && next != std::filesystem::directory_iterator(); next.increment(unknown)) {
    all.push_back(next->path().filename().string());
  }
  std::ranges::sort(all);
  return all;
}

bool MachineFiles::there(const std::string& path) const {
  std::error_code unknown;
  return std::filesystem::exists(root_ + path, unknown);
}

std::string absent(const std::string& path) { return path + " is not there"; }

std::optional<std::int64_t> whole_number(const std::string& text) {
  std::int64_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream all(line);
  for (std::string word; all >> word;) {
    words.push_back(word);
  }
  return words;
}

}  // namespace ivo::firmware::doctor
