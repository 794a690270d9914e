// The console's server: see firmware/web/console_program.hpp.
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <span>

#include "firmware/web/console_program.hpp"

namespace {

using namespace ivo::firmware::web;

constexpr int kWrongInput = 2;
std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void on_signal(int) { stop.store(true, std::memory_order_relaxed); }

ConsolePlaces places() {
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const char* const state = std::getenv("XDG_STATE_HOME");
  return {.program_folder = program.parent_path().string(), .state_home = state != nullptr ? state : ""};
}

int refuse(const ivo::Error& error) {
  std::cerr << "ivo-console: " << error.message << '\n';
  return kWrongInput;
}

int run(std::span<const char* const> arguments) {
  const auto options = parse_console_options(arguments, places());
  if (!options.ok()) {
    return refuse(options.error());
  }
  if (options.value().help) {
    std::cout << console_usage();
    return 0;
  }
  const auto ran = run_console(options.value(), stop, std::cout);
  return ran.ok() ? 0 : refuse(ran.error());
}

}  // namespace

int main(int count, char** arguments) {
#if defined(__x86_64__) && defined(__AVX2__)
  if (__builtin_cpu_supports("avx2") == 0) {
    return refuse({"this processor has no AVX2; expected one, or a build with -DIVO_CPU=x86-64"});
  }
#endif
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run(std::span<const char* const>(arguments, static_cast<std::size_t>(count)).subspan(1));
  } catch (const std::exception& error) {
    return refuse({error.what()});
  }
}
