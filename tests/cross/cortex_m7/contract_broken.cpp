// Breaks a contract: to show that the emulator's exit status tells.
#include "config/base/contract.hpp"
#include "tests/cross/machine.hpp"

namespace ivo::cross {

int run() noexcept {
  volatile bool kept = false;
  IVO_CONTRACT(kept);
  return 0;
}

}  // namespace ivo::cross
