// Arm semihosting: the debugger, here QEMU, does what an operating system would ("Semihosting for AArch32 and AArch64",
// Arm 100863).
#pragma once

#include <cstdint>

namespace ivo::cross {

enum class SemihostingCall : std::uint32_t { kWrite0 = 0x04, kExitExtended = 0x20 };

/// `parameter` is the call's own: a pointer to text, or to a block of words.
inline void semihosting(SemihostingCall call, const void* parameter) noexcept {
  register std::uint32_t r0 asm("r0") = static_cast<std::uint32_t>(call);
  register const void* r1 asm("r1") = parameter;
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

/// Ends the emulator with this exit status.
[[noreturn]] inline void exit_with(std::uint32_t status) noexcept {
  constexpr std::uint32_t kApplicationExit = 0x20026;
  const std::uint32_t block[] = {kApplicationExit, status};
  for (;;) {
    semihosting(SemihostingCall::kExitExtended, block);
  }
}

}  // namespace ivo::cross
