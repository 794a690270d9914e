// What a simulated drive is, and what it is to do wrong and when, in its own time.
#pragma once

#include <cstdint>
#include <optional>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/sim/sim_fault.hpp"

namespace ivo::drivers {

struct SimScript {
  static constexpr Instant kNever = Instant::max();
  static constexpr std::size_t kEvents = 32;

  struct Refusal {
    ObjectAddress object;
    SdoAbort code{};
  };

  struct Stuck {
    ObjectAddress object;
    std::uint32_t value = 0;
    std::optional<SdoAbort> code;  ///< of every write to it; without one writes are confirmed and do nothing
  };

  std::optional<std::uint32_t> device_type;      ///< 1000h; none: as the EDS says
  std::optional<std::uint32_t> supported_modes;  ///< 6502h; none: as the EDS says
  bool refuse_mode = false;                      ///< 6060h is taken but 6061h stays 0
  std::optional<Refusal> refusal;                ///< every SDO access to this object is aborted
  std::optional<Stuck> stuck;                    ///< this object has this value, whatever is written
  Instant silent_from = kNever;                  ///< sends nothing at all
  Instant feedback_lost_from = kNever;           ///< sends no TPDO
  Instant heartbeat_lost_from = kNever;          ///< sends no heartbeat
  Instant reboot_at = kNever;
  Instant fault_at = kNever;
  std::uint16_t fault_code = 0x7300;  ///< of the EMCY: sensor

  /// Faults that come and go. Those at the same time happen in this order; more may be added while the drive runs.
  StaticVector<SimEvent, kEvents> events;

  std::uint32_t noise_counts = 0;  ///< of the encoder: each position is up to so many counts off, either way
  std::uint32_t seed = 1;          ///< of the noise
  double coast_radps2 = 50.0;      ///< at the wheel: how a wheel without power slows down
};

}  // namespace ivo::drivers
