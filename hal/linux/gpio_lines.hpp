// Input lines of a GPIO chip of the Linux kernel, through libgpiod. Reading them is a system call, and may wait.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::hal {

/// One thread. Bits as in hal/api/digital_io.hpp.
class GpioLines {
 public:
  virtual ~GpioLines() = default;

  /// Waits for an edge, or `limit`; which inputs were pressed by edges since the last call. On trouble it waits all the
  /// same, so that a loop around it does not spin.
  [[nodiscard]] virtual std::uint8_t wait(Duration limit) noexcept = 0;

  /// Which inputs are pressed now; nothing when one could not be read.
  [[nodiscard]] virtual std::optional<std::uint8_t> read() noexcept = 0;
};

/// Requests the lines that `inputs` names, for input, with both edges where the chip can tell of edges; where it
/// cannot, reading alone must do. Fails by name on a chip or a line that is not there, is used by somebody else, or may
/// not be used.
[[nodiscard]] Result<std::unique_ptr<GpioLines>> open_gpio_lines(const InputParameters& inputs);

}  // namespace ivo::hal
