// Every COB-ID that has a meaning on a robot's bus: what the socket's filter lets through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "config/base/static_vector.hpp"
#include "config/robot.hpp"

namespace ivo::drivers {

/// NMT, SYNC, the master's heartbeat; EMCY, PDO 1 to 4 both ways, SDO both ways and heartbeat of each drive.
inline constexpr std::size_t kBusIds = 3 + kWheels * (1 + 4 + 4 + 2 + 1);
using BusIds = StaticVector<std::uint16_t, kBusIds>;

/// In ascending order, each once. What only a master sends (NMT, SYNC, RPDO, SDO requests, its heartbeat) is among
/// them: our own come back as the confirmation that they left, anybody else's tell of another master. All PDOs are: a
/// drive that cannot be mapped anew may use any of them. LSS and SDO of other nodes are not.
[[nodiscard]] BusIds bus_ids(const Robot& robot) noexcept;

/// NMT, SYNC, the master's heartbeat, an SDO request or an RPDO, 1 to 4, to one of `node_ids`.
[[nodiscard]] bool only_a_master_sends(std::uint16_t id, std::span<const std::uint8_t> node_ids,
                                       std::uint8_t master_node_id) noexcept;

}  // namespace ivo::drivers
