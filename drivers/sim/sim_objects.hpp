// The object dictionary of a simulated wheel drive: what an EDS says, with the numbers of one robot's drive.
#pragma once

#include <optional>

#include "config/robot.hpp"
#include "drivers/eds/eds_dictionary.hpp"
#include "drivers/sim/object_dictionary.hpp"
#include "drivers/sim/sim_script.hpp"

namespace ivo::drivers {

// Objects that the simulated drive looks at beyond those that the product does.
namespace sim_object {
inline constexpr ObjectAddress kErrorCount{0x1003, 0};
inline constexpr ObjectAddress kSyncWindow{0x1007, 0};  // microseconds
inline constexpr ObjectAddress kEmcyCobId{0x1014, 0};
inline constexpr ObjectAddress kEmcyInhibit{0x1015, 0};  // 100 microseconds
inline constexpr ObjectAddress kSyncOverflow{0x1019, 0};
inline constexpr ObjectAddress kErrorBehaviour{0x1029, 1};
inline constexpr ObjectAddress kShutdownOption{0x605B, 0};
inline constexpr ObjectAddress kDisableOption{0x605C, 0};
inline constexpr ObjectAddress kHaltOption{0x605D, 0};
inline constexpr ObjectAddress kFaultOption{0x605E, 0};
inline constexpr ObjectAddress kMaxProfileVelocity{0x607F, 0};
inline constexpr ObjectAddress kMaxMotorSpeed{0x6080, 0};
}  // namespace sim_object

/// What keeps an EDS from being simulated; none when nothing does.
struct SimUnfit {
  bool too_many = false;  ///< objects: more than ObjectDictionary holds
  ObjectAddress missing;  ///< that a wheel drive cannot do without
};
[[nodiscard]] std::optional<SimUnfit> sim_unfit(const EdsDictionary& eds) noexcept;

/// Where the EDS gives no default: the robot's vendor-ID and product code, and ramps (6083h to 6085h) of 50 rad/s2 and,
/// for the quick stop, 100 rad/s2 at the wheel. Programmer's contract: the EDS is fit.
void add_sim_objects(ObjectDictionary& objects, const EdsDictionary& eds, const DriveParameters& drive,
                     const SimScript& script) noexcept;

}  // namespace ivo::drivers
