// Simulated wheel drives on a CAN interface: see firmware/tools/drives_command.hpp.
#include <atomic>
#include <csignal>
#include <iostream>
#include <span>

#include "firmware/tools/drives_command.hpp"
#include "firmware/tools/exit_status.hpp"

namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void on_signal(int) { stop.store(true, std::memory_order_relaxed); }

int refuse(const ivo::Error& error) {
  std::cerr << "ivo-drives: " << error.message << '\n';
  return ivo::firmware::exit_status::kWrongInput;
}

}  // namespace

int main(int count, char** arguments) {
  const auto options = ivo::firmware::parse_drives_options(
      std::span<const char* const>(arguments, static_cast<std::size_t>(count)).subspan(1));
  if (!options.ok()) {
    return refuse(options.error());
  }
  if (options.value().help) {
    std::cout << ivo::firmware::drives_usage();
    return 0;
  }
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  const auto ran = ivo::firmware::run_drives(options.value(), stop, std::cout);
  return ran.ok() ? 0 : refuse(ran.error());
}
