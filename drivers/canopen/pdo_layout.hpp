// Which COB-IDs the four drives' process data have in each layout, and the frames that carry one write of the group.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/pdo.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

/// One drive's PDOs, by COB-ID.
struct PdoChannels {
  std::uint16_t command_id = 0;   ///< RPDO: kOwn {6040h, 60FFh}, kShared {6040h}
  std::uint16_t targets_id = 0;   ///< RPDO that a pair of drives takes: kShared {60FFh, 60FFh}; kOwn: 0, none
  std::uint16_t feedback_id = 0;  ///< TPDO {6041h, 6064h}
  friend bool operator==(const PdoChannels&, const PdoChannels&) = default;
};

/// As start-up maps them: RPDO1 and TPDO1 of the predefined connection set; the shared targets have RPDO2 of the first
/// drive of their pair (front, rear). A drive that cannot be mapped so may have others (drive_startup.hpp).
[[nodiscard]] PdoChannels standard_channels(const Robot& robot, Wheel wheel) noexcept;

/// The first drive of the pair that shares its targets with `drive`.
[[nodiscard]] constexpr std::size_t first_of_pair(std::size_t drive) noexcept { return drive / 2 * 2; }

using GroupChannels = std::array<PdoChannels, kWheels>;
using GroupCommands = std::array<DriveCommand, kWheels>;
using ControlwordsDue = std::array<bool, kWheels>;
using CommandFrames = StaticVector<hal::CanFrame, kWheels + kWheels / 2>;

/// The frames of one write, in the order in which they are to be sent. kOwn: one a drive, whatever is due. kShared: the
/// controlwords that are due, then the targets of both pairs: where not all leave, those that stop come first.
[[nodiscard]] CommandFrames command_frames(PdoLayout layout, const GroupChannels& channels,
                                           const GroupCommands& commands, const ControlwordsDue& due) noexcept;

/// Says when kShared sends a controlword: when it changes, and rates::kControlwordRefresh after it was last sent. The
/// refreshes of the four are spread, so that no cycle carries all of them.
class ControlwordSchedule {
 public:
  /// Which go out now; they count as sent.
  [[nodiscard]] ControlwordsDue due(const GroupCommands& commands, Instant now) noexcept;
  /// What was sent may not have left, or may have been forgotten: all are due.
  void forget() noexcept { known_ = false; }

 private:
  bool known_ = false;
  std::array<std::uint16_t, kWheels> words_{};
  std::array<Instant, kWheels> refresh_{};
};

}  // namespace ivo::drivers
