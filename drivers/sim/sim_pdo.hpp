// The process data objects of a simulated device: what of them is configured, what may be, and when they go.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/sim/object_dictionary.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

inline constexpr std::size_t kSimPdos = 4;  ///< each way
inline constexpr std::size_t kSimMappedObjects = 8;

struct SimMapped {
  ObjectAddress address;
  std::uint8_t bytes = 0;

  /// Room for another node's data (CiA 301, 7.4.7.1): nothing is written from it.
  [[nodiscard]] bool dummy() const noexcept { return address.index < 0x20; }
};

/// One PDO as its communication and mapping objects say.
struct SimPdo {
  bool valid = false;
  std::uint16_t cob_id = 0;
  std::uint8_t type = 0xFF;
  Duration inhibit{};  ///< TPDO
  Duration timer{};    ///< TPDO: event timer; RPDO: deadline
  StaticVector<SimMapped, kSimMappedObjects> mapped;
  std::uint8_t bytes = 0;

  [[nodiscard]] bool synchronous() const noexcept { return type <= 240; }
};

/// Of PDO `number` from 0, received (RPDO) or not.
[[nodiscard]] SimPdo sim_pdo(const ObjectDictionary& objects, std::size_t number, bool received) noexcept;

[[nodiscard]] bool is_pdo_object(std::uint16_t index) noexcept;
/// Why `value` cannot be written to one of a PDO's objects; none when it can. `dummies`: bit n, a dummy of type n.
[[nodiscard]] std::optional<SdoAbort> pdo_refusal(const ObjectDictionary& objects, ObjectAddress address,
                                                  std::uint32_t value, std::uint32_t dummies) noexcept;

/// When a TPDO goes out, and with what.
class SimTpdo {
 public:
  void configure(const SimPdo& pdo) noexcept;
  /// Operational again: everything is new.
  void start() noexcept;
  [[nodiscard]] const SimPdo& pdo() const noexcept { return pdo_; }
  /// At SYNC: the frame, when it is due.
  [[nodiscard]] std::optional<hal::CanFrame> on_sync(const ObjectDictionary& objects, Instant now) noexcept;
  /// At any time: the frame of an event-driven one, when something changed or its timer ran out.
  [[nodiscard]] std::optional<hal::CanFrame> on_time(const ObjectDictionary& objects, Instant now) noexcept;

 private:
  [[nodiscard]] hal::CanFrame content(const ObjectDictionary& objects) const noexcept;
  hal::CanFrame sent(const hal::CanFrame& frame, Instant now) noexcept;

  SimPdo pdo_;
  std::uint8_t syncs_ = 0;
  std::optional<hal::CanFrame> last_;
  Instant last_at_{};
};

}  // namespace ivo::drivers
