#include "firmware/tools/wheels/raw_terminal.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>

namespace ivo::firmware::wheels {
namespace {

// For the handler of a fatal signal, which finds nothing else.
termios before{};
std::atomic<bool> raw{false};
constexpr std::array kFatal{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

void put_back() noexcept {
  if (raw.exchange(false)) {
    (void)tcsetattr(STDIN_FILENO, TCSANOW, &before);
  }
}

// Its disposition is the default again when it runs (SA_RESETHAND).
extern "C" void on_fatal_signal(int number) {
  put_back();
  (void)raise(number);
}

}  // namespace

bool RawTerminal::possible() { return isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0; }

RawTerminal::RawTerminal() {
  if (tcgetattr(STDIN_FILENO, &before) != 0) {
    closed_ = true;
    return;
  }
  struct sigaction action {};
  action.sa_handler = on_fatal_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int number : kFatal) {
    (void)sigaction(number, &action, nullptr);
  }
  termios keys = before;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG | IEXTEN);
  keys.c_iflag &= ~static_cast<tcflag_t>(IXON | ICRNL);
  keys.c_cc[VMIN] = 0;
  keys.c_cc[VTIME] = 0;
  raw.store(true);
  (void)tcsetattr(STDIN_FILENO, TCSAFLUSH, &keys);
}

RawTerminal::~RawTerminal() { put_back(); }

std::string RawTerminal::keys(int wait_ms) {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (closed_ || ::poll(&input, 1, wait_ms) <= 0) {
    return {};
  }
  std::array<char, 256> text{};
  const ssize_t size = ::read(STDIN_FILENO, text.data(), text.size());
  closed_ = (input.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0 || (size < 0 && errno != EAGAIN && errno != EINTR);
  return {text.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

void RawTerminal::forget_keys() { (void)tcflush(STDIN_FILENO, TCIFLUSH); }

}  // namespace ivo::firmware::wheels
