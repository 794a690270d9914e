#include "tests/cross/machine.hpp"

#include <array>
#include <cstdint>

#include "tests/cross/cortex_m7/semihosting.hpp"

namespace ivo::cross {

void print(std::string_view text) noexcept {
  std::array<char, 64> part{};  // the call wants a zero at the end
  while (!text.empty()) {
    const std::size_t count = text.copy(part.data(), part.size() - 1);
    part[count] = '\0';
    semihosting(SemihostingCall::kWrite0, part.data());
    text.remove_prefix(count);
  }
}

// CMSDK timer 0 (Arm DDI 0479, 4.3): counts down at 25 MHz, a tick every 40 ns. With `-icount shift=6` QEMU lets each
// instruction take 64 ns of its virtual time: 8 ticks are 5 instructions, and no instruction is too short to be seen.
struct Timer {
  std::uint32_t control;
  std::uint32_t value;
  std::uint32_t reload;
};
unsigned instruction_clock() noexcept {
  auto* const timer = reinterpret_cast<volatile Timer*>(0x40000000);
  constexpr std::uint32_t kEnable = 1;
  if (timer->control != kEnable) {
    timer->reload = ~0U;
    timer->value = ~0U;
    timer->control = kEnable;
  }
  return ~timer->value;
}

InstructionsPerTick instructions_per_tick() noexcept { return {.instructions = 5, .ticks = 8}; }

}  // namespace ivo::cross
