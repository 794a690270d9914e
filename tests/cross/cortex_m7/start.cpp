// From reset to run() and from its end to the emulator's exit status. A fault is an exit status too.
#include <cstdint>
#include <cstring>

#include "tests/cross/cortex_m7/semihosting.hpp"
#include "tests/cross/machine.hpp"

// The linker script's.
extern "C" {
extern char zeroed_begin[], zeroed_end[];
extern char planner_begin[], planner_end[];
extern char stack_top[];
using Constructor = void (*)();
extern const Constructor constructors_begin[], constructors_end[];
}

namespace ivo::cross {
namespace {

void enable_fpu() noexcept {
  // CPACR: full access to CP10 and CP11 (Armv7-M Architecture Reference Manual, B3.2.20).
  auto* const cpacr = reinterpret_cast<volatile std::uint32_t*>(0xE000ED88);
  *cpacr = *cpacr | 0xFU << 20U;
  asm volatile("dsb\n isb" ::: "memory");
}

[[noreturn]] void start() noexcept {
  std::memset(zeroed_begin, 0, static_cast<std::size_t>(zeroed_end - zeroed_begin));
  std::memset(planner_begin, 0, static_cast<std::size_t>(planner_end - planner_begin));
  for (const Constructor* construct = constructors_begin; construct != constructors_end; ++construct) {
    (*construct)();
  }
  exit_with(static_cast<std::uint32_t>(run()));
}

[[noreturn]] void fault() noexcept {
  constexpr std::uint32_t kFaulted = 70;
  print("cortex-m7: fault\n");
  exit_with(kFaulted);
}

}  // namespace
}  // namespace ivo::cross

extern "C" [[noreturn]] void reset() {
  ivo::cross::enable_fpu();  // before any function that saves floating-point registers
  ivo::cross::start();
}

namespace {

using Handler = void (*)();
struct Vectors {
  const char* stack;
  Handler reset;
  Handler faults[14];  // NMI, the four faults, and what is never enabled
};
[[gnu::section(".vectors"), gnu::used]] const Vectors vectors = {
    stack_top,
    reset,
    {ivo::cross::fault, ivo::cross::fault, ivo::cross::fault, ivo::cross::fault, ivo::cross::fault, ivo::cross::fault,
     ivo::cross::fault, ivo::cross::fault, ivo::cross::fault, ivo::cross::fault, ivo::cross::fault, ivo::cross::fault,
     ivo::cross::fault, ivo::cross::fault}};

}  // namespace
