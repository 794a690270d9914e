// IVO_CONTRACT states what a programmer must never break. It is evaluated in every build and never on input:
// wrong input is refused with a sentence (result.hpp), trouble at run time is a status and a counter.
#pragma once

#define IVO_CONTRACT(condition) \
  do {                          \
    if (!(condition)) {         \
      __builtin_trap();         \
    }                           \
  } while (false)
