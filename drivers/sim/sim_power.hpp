// The power state machine of a CiA 402 drive, the drive's side (CiA 402-2, 6.2, figure 6), with its option codes.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/cia402/statusword.hpp"

namespace ivo::drivers {

/// How the motor is to turn now.
enum class SimMotorAction : std::uint8_t {
  kFollow,     ///< the target
  kRamp,       ///< to rest with 6084h
  kQuickRamp,  ///< to rest with 6085h
  kCoast,      ///< no power
};

/// Of 605Ah to 605Eh; those that the simulated drive has.
struct SimOptionCodes {
  std::uint8_t quick_stop = 2;      ///< 0 off, 1 and 5 ramp, 2 and 6 quick-stop ramp; from 5 on it stays
  std::uint8_t shutdown = 0;        ///< 0 off, 1 ramp
  std::uint8_t disable = 1;         ///< 0 off, 1 ramp
  std::uint8_t halt = 1;            ///< 1 ramp, 2 quick-stop ramp
  std::uint8_t fault_reaction = 2;  ///< 0 off, 1 ramp, 2 quick-stop ramp
};

class SimPower {
 public:
  [[nodiscard]] cia402::PowerState state() const noexcept { return state_; }
  [[nodiscard]] SimMotorAction action(const SimOptionCodes& options) const noexcept;
  [[nodiscard]] bool halted() const noexcept { return halt_; }

  /// A controlword arrived: at most one transition, except that 0Fh takes Ready to Switch On through transitions 3
  /// and 4. Shutdown and disable operation of a wheel that turns wait for their ramp, if they have one.
  void command(std::uint16_t controlword, const SimOptionCodes& options = SimOptionCodes()) noexcept;
  /// As if the master had asked; without effect below Operation Enabled.
  void quick_stop(const SimOptionCodes& options = SimOptionCodes()) noexcept;
  void disable_voltage() noexcept;
  /// Transition 13; where there is no reaction, 14 too.
  void fault(const SimOptionCodes& options = SimOptionCodes()) noexcept;
  /// The wheel stands.
  void at_rest(const SimOptionCodes& options = SimOptionCodes()) noexcept;
  /// No voltage: Switch On Disabled, and nothing leads out of it.
  void set_voltage(bool present) noexcept;
  /// While true Operation Enabled is not to be had.
  void forbid_enabling(bool forbidden) noexcept;
  /// Power on; the voltage is as it was.
  void reset() noexcept;

 private:
  void leave(cia402::PowerState goal, bool ramp) noexcept;

  cia402::PowerState state_ = cia402::PowerState::kSwitchOnDisabled;
  std::optional<cia402::PowerState> leaving_for_;  // Operation Enabled, after the ramp
  std::uint16_t last_word_ = 0;
  bool halt_ = false;
  bool voltage_ = true;
  bool enabling_forbidden_ = false;
};

}  // namespace ivo::drivers
