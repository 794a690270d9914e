#include "drivers/canopen/bus_ids.hpp"

#include <algorithm>

#include "config/base/contract.hpp"
#include "drivers/canopen/cob_id.hpp"

namespace ivo::drivers {

BusIds bus_ids(const Robot& robot) noexcept {
  BusIds ids;
  const auto add = [&ids](std::uint16_t id) {
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) {
      IVO_CONTRACT(ids.push_back(id));
    }
  };
  add(cob_id::kNmt);
  add(cob_id::kSync);
  add(cob_id::heartbeat(robot.master_node_id));
  for (const DriveParameters& drive : robot.drives) {
    add(cob_id::emcy(drive.node_id));
    for (std::uint8_t number = 1; number <= cob_id::kPdos; ++number) {
      add(cob_id::tpdo(number, drive.node_id));
      add(cob_id::rpdo(number, drive.node_id));
    }
    add(cob_id::sdo_answer(drive.node_id));
    add(cob_id::sdo_request(drive.node_id));
    add(cob_id::heartbeat(drive.node_id));
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

bool only_a_master_sends(std::uint16_t id, std::span<const std::uint8_t> node_ids,
                         std::uint8_t master_node_id) noexcept {
  if (id == cob_id::kNmt || id == cob_id::kSync || id == cob_id::heartbeat(master_node_id)) {
    return true;
  }
  return std::ranges::any_of(node_ids, [id](std::uint8_t node_id) {
    bool command = id == cob_id::sdo_request(node_id);
    for (std::uint8_t number = 1; number <= cob_id::kPdos; ++number) {
      command = command || id == cob_id::rpdo(number, node_id);
    }
    return command;
  });
}

}  // namespace ivo::drivers
