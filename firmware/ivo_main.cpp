#include <cstdio>
#include <exception>

#include "firmware/tools/command_line.hpp"

int main(int argc, char** argv) {
  try {
    return ivo::firmware::command_line(argc, argv);
  } catch (const std::exception& error) {  // start-up may run out of memory; the loop throws nothing
    (void)std::fprintf(stderr, "ivo: %s\n", error.what());
    return 1;
  }
}
