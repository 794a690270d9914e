// The bus, the clock and, in process, the drives of one run: which of the three buses it is, is decided here and
// nowhere else.
#pragma once

#include <memory>
#include <string>

#include "config/base/result.hpp"
#include "config/robot.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/tools/run_options.hpp"
#include "hal/api/can_bus.hpp"
#include "hal/api/clock.hpp"
#include "hal/sim/digital_inputs.hpp"

namespace ivo::firmware {

class RunWorld {
 public:
  virtual ~RunWorld() = default;

  /// What time is, and whether a lost period says something about a robot.
  enum class Time : std::uint8_t {
    kSimulated,           ///< it waits for the loop, or is forgiven to a late host
    kRealOnSimulatedBus,  ///< as vcan: real time where it is granted, overruns are only counted
    kReal,                ///< a robot: real time is required
  };

  /// Fails when the interface cannot be used or the options do not fit together.
  [[nodiscard]] static Result<std::unique_ptr<RunWorld>> open(const RunOptions& options, const Robot& robot);

  [[nodiscard]] virtual hal::CanBus& bus() noexcept = 0;
  [[nodiscard]] virtual hal::Clock& clock() noexcept = 0;
  /// The host's time, to measure with; where time is real, clock() itself.
  [[nodiscard]] virtual hal::Clock& stopwatch() noexcept = 0;
  [[nodiscard]] virtual Time time() const noexcept = 0;
  /// Emergency stop and bumpers. Those of simulated worlds are never pressed.
  [[nodiscard]] virtual hal::DigitalInputs* inputs() noexcept { return &released_; }
  /// After each cycle, before the sleep.
  virtual void after_cycle(const ControlLoop& loop) noexcept = 0;
  /// Time stands still because the drives no longer answer.
  [[nodiscard]] virtual bool stalled() const noexcept { return false; }
  /// How often the host was late for simulated time.
  [[nodiscard]] virtual std::uint64_t lapses() const noexcept { return 0; }
  /// Time is not the host's: cycles run in the caller's thread, one after the other.
  [[nodiscard]] virtual bool own_time() const noexcept = 0;
  /// For a person: "virtual bus, four simulated drives in this process".
  [[nodiscard]] virtual std::string description() const = 0;

 private:
  hal::SimDigitalInputs released_;
};

}  // namespace ivo::firmware
