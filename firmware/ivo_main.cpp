#include <cstdio>
#include <exception>

#include "firmware/tools/command_line.hpp"

int main(int argc, char** argv) {
#if defined(__x86_64__) && defined(__AVX2__)
  if (__builtin_cpu_supports("avx2") == 0) {
    (void)std::fprintf(stderr, "ivo: this processor has no AVX2; expected one, or a build with -DIVO_CPU=x86-64\n");
    return 1;
  }
#endif
  try {
    return ivo::firmware::command_line(argc, argv);
  } catch (const std::exception& error) {  // start-up may run out of memory; the loop throws nothing
    (void)std::fprintf(stderr, "ivo: %s\n", error.what());
    return 1;
  }
}
