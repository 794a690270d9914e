#include "firmware/files/candump_file.hpp"

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

namespace ivo::firmware {
namespace {

constexpr std::size_t kStandardIdDigits = 3;
constexpr std::size_t kExtendedIdDigits = 8;
constexpr std::int64_t kLatestSecond = 9'000'000'000;  // in nanoseconds it still fits

struct Line {
  Instant at{};
  std::string_view interface;
  std::optional<hal::CanFrame> frame;  // none: not a data frame with an 11-bit identifier
};

/// The next word of `text`, which loses it.
std::string_view word(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  const std::size_t end = std::min(text.find(' ', begin), text.size());
  const std::string_view found = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return found;
}

template <class Number>
bool read_number(std::string_view text, Number& number, int base) {
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return status == std::errc() && end == text.data() + text.size() && !text.starts_with('-');
}

/// "(1436509052.249713)"
std::optional<Instant> read_time(std::string_view text) {
  const std::size_t point = text.find('.');
  std::int64_t second = 0;
  std::int64_t us = 0;
  if (!text.starts_with('(') || !text.ends_with(')') || point == std::string_view::npos || text.size() - point != 8 ||
      !read_number(text.substr(1, point - 1), second, 10) || !read_number(text.substr(point + 1, 6), us, 10) ||
      second > kLatestSecond) {
    return std::nullopt;
  }
  return Instant(std::chrono::seconds(second) + std::chrono::microseconds(us));
}

std::optional<hal::CanFrame> read_data(std::uint16_t id, std::string_view hex) {
  hal::CanFrame frame{.id = id, .size = 0, .data = {}};
  if (hex.size() % 2 != 0 || hex.size() > 2 * frame.data.size()) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < hex.size() / 2; ++i) {
    if (!read_number(hex.substr(2 * i, 2), frame.data[i], 16)) {
      return std::nullopt;
    }
  }
  frame.size = static_cast<std::uint8_t>(hex.size() / 2);
  return frame;
}

/// None when `text` is no line of a record.
std::optional<Line> read_line(std::string_view text) {
  const std::optional<Instant> at = read_time(word(text));
  Line line{.at = at.value_or(Instant{}), .interface = word(text), .frame = {}};
  const std::string_view content = word(text);
  const std::size_t hash = content.find('#');
  std::uint32_t id = 0;
  if (!at.has_value() || line.interface.empty() || hash == std::string_view::npos ||
      (hash != kStandardIdDigits && hash != kExtendedIdDigits) || !read_number(content.substr(0, hash), id, 16)) {
    return std::nullopt;
  }
  const std::string_view data = content.substr(hash + 1);
  if (hash == kExtendedIdDigits || data.starts_with('#') || data.starts_with('R')) {
    return line;
  }
  if (id > 0x7FF) {
    return std::nullopt;
  }
  line.frame = read_data(static_cast<std::uint16_t>(id), data);
  return line.frame.has_value() ? std::optional(line) : std::nullopt;
}

}  // namespace

Result<CandumpContents> read_candump(const std::string& path,
                                     const std::function<void(Instant, const hal::CanFrame&)>& each) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) {
    return Error{path + ": cannot be read: it is a folder; expected a file"};
  }
  std::ifstream file(path);
  if (!file) {
    return Error{path + ": cannot be read: " + std::strerror(errno)};
  }
  CandumpContents contents;
  std::string text;
  for (std::uint64_t number = 1; std::getline(file, text); ++number) {
    if (text.empty()) {
      continue;
    }
    const std::optional<Line> line = read_line(text);
    if (!line.has_value()) {
      return Error{path + ":" + std::to_string(number) +
                   ": no line of a record of frames; expected one as \"(1436509052.249713) can0 181#112233445566\""};
    }
    if (contents.interface.empty()) {
      contents.interface = line->interface;
    }
    if (line->interface != contents.interface) {
      ++contents.elsewhere;
    } else if (!line->frame.has_value()) {
      ++contents.others;
    } else {
      ++contents.frames;
      each(line->at, *line->frame);
    }
  }
  if (file.bad()) {
    return Error{path + ": cannot be read to its end"};
  }
  return contents;
}

}  // namespace ivo::firmware
