// What a simulated drive is, and what it is to do wrong and when, in its own time.
#pragma once

#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"

namespace ivo::drivers {

struct SimScript {
  static constexpr Instant kNever = Instant::max();

  struct Refusal {
    ObjectAddress object;
    SdoAbort code{};
  };

  struct Stuck {
    ObjectAddress object;
    std::uint32_t value = 0;
    std::optional<SdoAbort> code;  ///< of every write to it; without one writes are confirmed and do nothing
  };

  std::uint32_t device_type = 0x0002'0192;      ///< 1000h
  std::uint32_t supported_modes = 0x0000'0104;  ///< 6502h: profile velocity, cyclic synchronous velocity
  bool refuse_mode = false;                     ///< 6060h is taken but 6061h stays 0
  std::optional<Refusal> refusal;               ///< every SDO access to this object is aborted
  std::optional<Stuck> stuck;                   ///< this object has this value, whatever is written
  Instant silent_from = kNever;                 ///< sends nothing at all
  Instant feedback_lost_from = kNever;          ///< sends no TPDO1
  Instant heartbeat_lost_from = kNever;         ///< sends no heartbeat
  Instant reboot_at = kNever;
  Instant fault_at = kNever;
  std::uint16_t fault_code = 0x7300;  ///< of the EMCY: sensor
};

}  // namespace ivo::drivers
