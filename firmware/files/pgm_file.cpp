#include "firmware/files/pgm_file.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/files/png_file.hpp"

namespace ivo::firmware {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The next whole number of the text; comments, from # to the line's end, and white space before it are passed over.
std::optional<int> next_number(std::string_view& text) {
  constexpr int kMost = 1'000'000'000;
  while (!text.empty() && (is_space(text.front()) || text.front() == '#')) {
    const std::size_t end = text.front() == '#' ? text.find('\n') : 0;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  if (text.empty() || !is_digit(text.front())) {
    return std::nullopt;
  }
  std::int64_t number = 0;
  while (!text.empty() && is_digit(text.front()) && number <= kMost) {
    number = number * 10 + (text.front() - '0');
    text.remove_prefix(1);
  }
  return number <= kMost ? std::optional<int>(static_cast<int>(number)) : std::nullopt;
}

}  // namespace

Result<PgmImage> parse_pgm(std::string_view bytes, const std::string& path) {
  const bool binary = bytes.substr(0, 2) == "P5";
  if (!binary && bytes.substr(0, 2) != "P2") {
    return Error{path + ": not a PGM; expected one that begins with P5 or P2"};
  }
  std::string_view left = bytes.substr(2);
  const std::optional<int> width = next_number(left);
  const std::optional<int> height = width ? next_number(left) : std::nullopt;
  const std::optional<int> white = height ? next_number(left) : std::nullopt;
  if (!white || *width < 1 || *height < 1 || *white < 1 || *white > 65535) {
    return Error{path + ": its header will not do; expected width, height and a white of 1 to 65535"};
  }
  const std::int64_t pixels = std::int64_t{*width} * *height;
  if (pixels > kMostPixels) {
    return Error{path + ": " + std::to_string(*width) + " x " + std::to_string(*height) +
                 " pixels are too many; expected at most " + std::to_string(kMostPixels)};
  }
  const auto count = static_cast<std::size_t>(pixels);
  const std::size_t size = *white > 255 ? 2 : 1;
  if (left.empty() || !is_space(left.front()) || left.size() - 1 < (binary ? count * size : count)) {
    return Error{path + ": cut short; expected " + std::to_string(count) + " pixels after its header"};
  }
  left.remove_prefix(1);
  if (binary && left.size() > count * size) {
    return Error{path + ": goes on after its last pixel; expected one image and nothing more"};
  }
  PgmImage image{{*width, *height, std::vector<std::uint16_t>(count)}, *white};
  for (std::size_t i = 0; i < count; ++i) {
    int value = 0;
    if (binary) {
      const auto byte = [&](std::size_t k) { return static_cast<int>(static_cast<unsigned char>(left[i * size + k])); };
      value = size == 2 ? byte(0) * 256 + byte(1) : byte(0);
    } else if (const std::optional<int> next = next_number(left)) {
      value = *next;
    } else {
      return Error{path + ": pixel " + std::to_string(i) + " is no whole number; expected " + std::to_string(count) +
                   " pixels"};
    }
    if (value > *white) {
      return Error{path + ": pixel " + std::to_string(i) + " is " + std::to_string(value) + "; expected at most " +
                   std::to_string(*white) + ", white"};
    }
    const std::size_t row = static_cast<std::size_t>(*height) - 1 - i / static_cast<std::size_t>(*width);
    image.grey.values[row * static_cast<std::size_t>(*width) + i % static_cast<std::size_t>(*width)] =
        static_cast<std::uint16_t>(value);
  }
  return image;
}

}  // namespace ivo::firmware
