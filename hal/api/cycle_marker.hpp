// Somebody beside us who wants to know, as it happens, where a cycle is.
#pragma once

#include <cstddef>

namespace ivo::hal {

class CycleMarker {
 public:
  virtual ~CycleMarker() = default;
  /// The cycle begins, and its first phase.
  virtual void begin_cycle() noexcept = 0;
  /// This phase ends and the next begins.
  virtual void end_phase(std::size_t phase) noexcept = 0;
  virtual void end_cycle() noexcept = 0;
};

}  // namespace ivo::hal
