// What the bus itself tells: whether it is still there, whether frames are lost or ours are refused, and whether
// somebody else plays the master.
#pragma once

#include <cstddef>
#include <cstdint>

#include "config/robot.hpp"
#include "drivers/drive_fault.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::drivers {

/// Each cycle: on_frame for every frame received, then update. Own frames are not heard (hal/api/can_bus.hpp), so each
/// frame that only this master may send - NMT, SYNC, our heartbeat, an SDO request or an RPDO to one of our drives - is
/// another master's.
class BusWatch {
 public:
  /// Of our COB-IDs: a healthy cycle has at most 16, four each of TPDO, heartbeat, EMCY and SDO answer.
  static constexpr std::size_t kFloodFrames = 24;
  static constexpr int kFloodCycles = 5;  ///< in a row

  explicit BusWatch(const Robot& robot) noexcept;

  /// Forgets what was seen; what was lost or refused before counts no more.
  void open(const hal::CanBus& bus) noexcept;
  void on_frame(const hal::CanFrame& frame) noexcept;
  /// `synchronous`: PDOs run. An error-passive controller is forgiven before that: drives may just be powered up.
  void update(const hal::CanBus& bus, bool synchronous) noexcept;

  /// Of the cycle that the last update ended; reason kNone when all is well.
  [[nodiscard]] const DriveFault& fault() const noexcept { return fault_; }

 private:
  std::array<std::uint8_t, kWheels> node_ids_{};
  std::uint8_t master_node_id_;
  std::uint64_t lost_before_ = 0;
  std::uint64_t refused_before_ = 0;
  std::size_t frames_ = 0;  // of this cycle
  int flooded_cycles_ = 0;
  DriveFault foreign_;
  DriveFault fault_;
};

}  // namespace ivo::drivers
