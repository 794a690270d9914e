// The power state machine of a CiA 402 drive, the drive's side (CiA 402-2, 6.2, figure 6).
#pragma once

#include <cstdint>

#include "drivers/cia402/statusword.hpp"

namespace ivo::drivers {

class SimPower {
 public:
  [[nodiscard]] cia402::PowerState state() const noexcept { return state_; }

  /// A controlword arrived: at most one transition, except that 0Fh takes Ready to Switch On through transitions 3
  /// and 4.
  void command(std::uint16_t controlword) noexcept;
  /// As if the master had asked; without effect below Operation Enabled.
  void quick_stop() noexcept;
  void disable_voltage() noexcept;
  /// Transition 13.
  void fault() noexcept;
  /// The ramp of a quick stop or a fault reaction has come to rest. `stay` keeps Quick Stop Active (605Ah 5 to 8).
  void at_rest(bool stay) noexcept;
  /// Power on.
  void reset() noexcept;

 private:
  cia402::PowerState state_ = cia402::PowerState::kSwitchOnDisabled;
  std::uint16_t last_word_ = 0;
};

}  // namespace ivo::drivers
