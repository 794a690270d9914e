// libgpiod without a chip: the functions of its C interface that hal/linux/gpio_lines.cpp calls, here in the test
// program, over lines that a test drives. Each line's edges are records in a pipe.
#pragma once

#include <gpiod.h>

#include <array>
#include <string>

namespace ivo::hal {

struct FakeLine {
  int level = 0;
  bool edges_work = true;
  bool input_works = true;
  bool readable = true;
  std::string user{};  ///< who has it already
  bool active_low = false;
  bool requested = false;
  std::array<int, 2> pipe{-1, -1};
};

/// One chip, "gpiochip7", of eight lines; the only one there is while it lives.
class FakeChip {
 public:
  FakeChip();
  FakeChip(const FakeChip&) = delete;
  FakeChip& operator=(const FakeChip&) = delete;
  ~FakeChip();

  /// A new level, and the edge that it makes, as the kernel tells it: of the logical value.
  void set(unsigned line, int level);
  /// As if the chip were unplugged: descriptors say so, nothing can be read.
  void unplug();

  std::array<FakeLine, 8> lines{};
  int open_error = 0;  ///< errno of the next attempts to open it
  bool open = false;
};

}  // namespace ivo::hal
