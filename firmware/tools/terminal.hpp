// Lines on standard output for people: labelled ones that stay, and one that is drawn over itself.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"

namespace ivo::firmware {

/// printf into a string, cut at 511 characters.
template <class... Args>
[[nodiscard]] std::string format(const char* form, Args... args) {
  std::array<char, 512> text{};
  (void)std::snprintf(text.data(), text.size(), form, args...);
  return text.data();
}

/// "plans       ...", the label padded.
[[nodiscard]] std::string labelled(const char* label, const std::string& text);
void say(const char* label, const std::string& text);

/// "1 generation", "2 generations"
[[nodiscard]] std::string counted(int count, const char* thing);
/// "(1.5, 2.0)"
[[nodiscard]] std::string place_text(Point p);
/// "[######..................]"
[[nodiscard]] std::string bar(int part, int whole);

/// One line to standard error, whatever a path in the message may hold.
void complain(const Error& error);
/// The same, and the exit status of wrong input.
[[nodiscard]] int refuse(const Error& error);

/// Progress: drawn over itself on a terminal; elsewhere a line a tenth of the way.
class LiveLine {
 public:
  LiveLine();
  /// Whether now is a time to draw: on a terminal not more often than a person reads, elsewhere at each new tenth.
  [[nodiscard]] bool due(int part, int whole);
  void draw(const char* label, const std::string& text);
  /// Ends the line that is drawn over itself, and begins a new count of tenths.
  void end();
  [[nodiscard]] bool live() const noexcept { return live_; }

 private:
  bool live_;  // standard output is a terminal
  bool open_ = false;
  int tenth_shown_ = -1;
  std::chrono::steady_clock::time_point drawn_{};
};

}  // namespace ivo::firmware
