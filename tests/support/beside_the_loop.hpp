// What a test does where the loop stands in a cycle, and no robot would: a double of a bus that keeps what it has seen.
// Neither the heap trap nor RealtimeSanitizer counts it, so that they can count all else.
#pragma once

#include "config/base/realtime.hpp"
#include "tests/support/heap_trap.hpp"

namespace ivo::test {

class BesideTheLoop {
  HeapAgain heap_;
  KnownNotToWait rtsan_;
};

}  // namespace ivo::test
