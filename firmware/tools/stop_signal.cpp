#include "firmware/tools/stop_signal.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>

#include "firmware/tools/exit_status.hpp"

namespace ivo::firmware {
namespace {

std::atomic<bool> asked{false};
std::atomic<const char*> last_line{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free,
              "signal handlers use them");

extern "C" void on_signal(int /*number*/) { asked.store(true); }

// Only calls that a handler may make.
extern "C" void on_signal_end(int /*number*/) {
  const char* const line = last_line.load();
  (void)!write(STDERR_FILENO, line, std::strlen(line));
  _exit(exit_status::kFaultOrStop);
}

void handle_with(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    (void)sigaction(number, &action, nullptr);
  }
}

}  // namespace

void end_on_signals(const char* line) {
  last_line.store(line);
  handle_with(on_signal_end);
}

void stop_on_signals() {
  handle_with(on_signal);
  struct sigaction action {};
  action.sa_handler = SIG_IGN;
  (void)sigaction(SIGPIPE, &action, nullptr);
}

void stop_on_all_signals() {
  stop_on_signals();
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int number : {SIGQUIT, SIGTSTP}) {
    (void)sigaction(number, &action, nullptr);
  }
}

bool stop_asked() noexcept { return asked.load(); }

}  // namespace ivo::firmware
