#include "drivers/eds/eds_lines.hpp"

#include <algorithm>

#include "drivers/eds/eds_number.hpp"

namespace ivo::drivers {

EdsLines::EdsLines(std::string_view text) noexcept : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) {
    rest_.remove_prefix(kByteOrderMark.size());
  }
}

EdsLine EdsLines::next() noexcept {
  while (!rest_.empty() && !error_.has_value()) {
    ++number_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view whole = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    const std::string_view line = trimmed(whole);
    if (line.size() > kLineBytes) {
      return refuse(EdsProblem::kLineTooLong, line, line.size());
    }
    const auto* const control = std::find_if(line.begin(), line.end(), [](char c) {
      return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
    });
    if (control != line.end()) {
      return refuse(EdsProblem::kControlCharacter, {}, static_cast<unsigned char>(*control));
    }
    if (!line.empty() && line.front() != ';') {
      return parse(line);
    }
  }
  return {EdsLine::Kind::kEnd, number_, {}, {}};
}

EdsLine EdsLines::parse(std::string_view line) noexcept {
  if (line.front() == '[') {
    if (line.back() != ']') {
      return refuse(EdsProblem::kSectionNotClosed, line, 0);
    }
    return {EdsLine::Kind::kSection, number_, trimmed(line.substr(1, line.size() - 2)), {}};
  }
  const std::size_t equals = line.find('=');
  const std::string_view name = trimmed(line.substr(0, std::min(equals, line.size())));
  if (equals == std::string_view::npos || name.empty()) {
    return refuse(EdsProblem::kNotALine, line, 0);
  }
  return {EdsLine::Kind::kKey, number_, name, trimmed(line.substr(equals + 1))};
}

EdsLine EdsLines::refuse(EdsProblem problem, std::string_view found, std::uint64_t number) noexcept {
  error_ = EdsError{.problem = problem,
                    .line = number_,
                    .section = {},
                    .key = {},
                    .found = ShortString<60>(found),
                    .type = DataType::kNone,
                    .number = number};
  return {EdsLine::Kind::kEnd, number_, {}, {}};
}

}  // namespace ivo::drivers
