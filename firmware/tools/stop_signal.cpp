#include "firmware/tools/stop_signal.hpp"

#include <atomic>
#include <csignal>

namespace ivo::firmware {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

extern "C" void on_signal(int /*number*/) { asked.store(true); }

}  // namespace

void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    (void)sigaction(number, &action, nullptr);
  }
  action.sa_handler = SIG_IGN;
  (void)sigaction(SIGPIPE, &action, nullptr);
}

bool stop_asked() noexcept { return asked.load(); }

}  // namespace ivo::firmware
