#include "firmware/tools/wheels/live_picture.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace ivo::firmware::wheels {

void LivePicture::draw(const std::vector<std::string>& lines) {
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  std::string text;
  if (drawn_ > 0) {
    text += "\033[" + std::to_string(drawn_) + "A";
  }
  for (const std::string& line : lines) {
    text += "\r\033[K" + (known ? line.substr(0, size.ws_col - 1U) : line) + "\r\n";
  }
  drawn_ = lines.size();
  (void)std::fwrite(text.data(), 1, text.size(), stdout);
  (void)std::fflush(stdout);
}

}  // namespace ivo::firmware::wheels
