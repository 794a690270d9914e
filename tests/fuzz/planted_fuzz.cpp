// Reads one byte beyond its input when that begins with "CAN": shows that the harness finds, says and keeps a crash.
#include <cstdlib>

#include "tests/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  volatile std::uint8_t seen = 0;
  if (size >= 3 && data[0] == 'C' && data[1] == 'A' && data[2] == 'N') {
    seen = data[size];
  }
  return seen == 256 ? 1 : 0;
}
