#include "firmware/tools/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "firmware/tools/exit_status.hpp"

namespace ivo::firmware {
namespace {

constexpr int kLabelWidth = 10;

// A line that is longer than the terminal cannot be drawn over itself.
std::string cut_to_terminal(const std::string& line) {
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? line.substr(0, size.ws_col - 1U) : line;
}

}  // namespace

std::string labelled(const char* label, const std::string& text) { return format("%-*s  ", kLabelWidth, label) + text; }

void say(const char* label, const std::string& text) {
  (void)std::printf("%s\n", labelled(label, text).c_str());
  (void)std::fflush(stdout);
}

std::string counted(int count, const char* thing) { return format("%d %s%s", count, thing, count == 1 ? "" : "s"); }

std::string place_text(Point p) { return format("(%.1f, %.1f)", p.x_m, p.y_m); }

std::string bar(int part, int whole) {
  constexpr int kWidth = 24;
  const int filled = whole > 0 ? static_cast<int>(static_cast<std::int64_t>(kWidth) * part / whole) : 0;
  return "[" + std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kWidth - filled), '.') + "]";
}

void complain(const Error& error) {
  // A path may hold anything; the message stays one line.
  std::string line = error.message;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  (void)std::fflush(stdout);
  (void)std::fprintf(stderr, "ivo: %s\n", line.c_str());
}

int refuse(const Error& error) {
  complain(error);
  return exit_status::kWrongInput;
}

LiveLine::LiveLine() : live_(isatty(STDOUT_FILENO) != 0) {}

bool LiveLine::due(int part, int whole) {
  if (!live_) {
    const int tenth = static_cast<int>(10 * static_cast<std::int64_t>(part) / std::max(1, whole));
    const bool next = tenth > tenth_shown_;
    tenth_shown_ = std::max(tenth, tenth_shown_);
    return next;
  }
  // A person reads no faster, and a search at full speed would spend its time drawing.
  const auto now = std::chrono::steady_clock::now();
  if (now - drawn_ < std::chrono::milliseconds(50)) {
    return false;
  }
  drawn_ = now;
  return true;
}

void LiveLine::draw(const char* label, const std::string& text) {
  if (!live_) {
    say(label, text);
    return;
  }
  (void)std::printf("\r\033[K%s", cut_to_terminal(labelled(label, text)).c_str());
  (void)std::fflush(stdout);
  open_ = true;
}

void LiveLine::end() {
  tenth_shown_ = -1;
  if (open_) {
    (void)std::printf("\n");
    open_ = false;
  }
}

}  // namespace ivo::firmware
