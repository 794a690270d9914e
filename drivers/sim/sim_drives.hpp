// The four simulated drives of a robot on one port of a bus.
#pragma once

#include <array>
#include <cstdint>

#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "drivers/sim/sim_drive.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::drivers {

class SimDrives {
 public:
  enum class TimeFrom : std::uint8_t {
    kClock,  ///< what update() is told
    kSync,   ///< each SYNC received is 1006h further, and nothing else moves time
  };

  using Scripts = std::array<SimScript, kWheels>;
  using Dictionaries = std::array<const EdsDictionary*, kWheels>;

  /// `bus` outlives this. Node-ids and units from `robot`; what they are from `dictionaries`, which must be fit
  /// (sim_objects.hpp) and are read here alone.
  SimDrives(hal::CanBus& bus, const Robot& robot, TimeFrom time_from, const Scripts& scripts = Scripts(),
            const Dictionaries& dictionaries = {&ivo_drive_eds(), &ivo_drive_eds(), &ivo_drive_eds(),
                                                &ivo_drive_eds()}) noexcept;

  /// Power on: four boot-up messages.
  void open() noexcept;
  /// Takes all frames received and sends the answers: for each frame drives 1 to 4, for each SYNC a drive's heartbeat
  /// and emergencies before its TPDOs, so that the last TPDO is the last frame. `now` is not looked at when time is
  /// from SYNC. What one drive sends as a master would (NMT, SYNC), all four hear.
  void update(Instant now) noexcept;

  [[nodiscard]] SimDrive& drive(Wheel wheel) noexcept { return drives_[static_cast<std::size_t>(wheel)]; }

 private:
  void handle(const hal::CanFrame& frame) noexcept;
  void hear_each_other() noexcept;
  void flush(Instant now) noexcept;

  hal::CanBus& bus_;
  TimeFrom time_from_;
  std::array<SimDrive, kWheels> drives_;
  SimDrive::Outbox out_;
  std::size_t heard_ = 0;  // of out_, by the drives
};

}  // namespace ivo::drivers
