// An EDS as a row of sections and keys: the INI syntax of CiA 306-1, 4.2.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/eds/eds_error.hpp"

namespace ivo::drivers {

struct EdsLine {
  enum class Kind : std::uint8_t { kSection, kKey, kEnd };
  Kind kind = Kind::kEnd;
  std::uint32_t number = 0;
  std::string_view name;   ///< of the section or key, without blanks around it
  std::string_view value;  ///< of the key
};

/// Walks over `text`, which outlives this. Comments and empty lines are not among the lines. Any of LF and CR LF ends
/// a line.
class EdsLines {
 public:
  static constexpr std::size_t kLineBytes = 1024;

  explicit EdsLines(std::string_view text) noexcept;

  /// The next line; kEnd after the last and when a line is wrong: error() says so.
  [[nodiscard]] EdsLine next() noexcept;
  [[nodiscard]] const std::optional<EdsError>& error() const noexcept { return error_; }

 private:
  [[nodiscard]] EdsLine parse(std::string_view line) noexcept;
  EdsLine refuse(EdsProblem problem, std::string_view found, std::uint64_t number) noexcept;

  std::string_view rest_;
  std::uint32_t number_ = 0;
  std::optional<EdsError> error_;
};

}  // namespace ivo::drivers
