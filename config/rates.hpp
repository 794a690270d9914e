// The periods, budgets and time-outs of robot and bus, once.
#pragma once

#include <chrono>

#include "config/base/time.hpp"

namespace ivo::rates {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""us;
using std::chrono_literals::operator""s;

inline constexpr Duration kCycle = 2ms;                     // 500 Hz: control loop and SYNC, unless the robot says 1 ms
inline constexpr Duration kShortestCycle = 1ms;             // with two shared RPDOs
inline constexpr Duration kControlwordRefresh = 50ms;       // of a layout whose controlwords go out when they change
inline constexpr Duration kMasterHeartbeat = 50ms;          // our heartbeat on the bus (1017h of the master)
inline constexpr Duration kMasterHeartbeatTimeout = 150ms;  // drives stop when ours is this late (1016h of each drive)
inline constexpr Duration kDriveHeartbeat = 50ms;           // each drive's heartbeat (1017h of each drive)
inline constexpr Duration kDriveHeartbeatTimeout = 150ms;   // a drive is lost when its heartbeat is this late
inline constexpr Duration kTransmitAge = 4ms;               // a frame that has not left by then is not sent any more
inline constexpr Duration kTransmitTimeout = 20ms;          // nothing leaves for so long: the bus is lost
inline constexpr Duration kFeedbackTimeout = 10ms;          // five SYNCs without the TPDO of a drive: it is lost
inline constexpr Duration kBootTimeout = 5s;                // from reset to boot-up message
inline constexpr Duration kSdoTimeout = 500ms;  // real drives answer in 6 to over 20 ms; shorter breaks start-up
inline constexpr int kSdoAttempts = 3;
inline constexpr int kResetLimit = 3;                    // fault resets within kResetWindow; then it is to be mended
inline constexpr Duration kResetWindow = 60s;            //
inline constexpr Duration kStateChangeTimeout = 1s;      // one CiA 402 transition
inline constexpr Duration kUnaskedPowerTimeout = 100ms;  // a drive may be powered unasked for so long
inline constexpr Duration kStandstillTimeout = 3s;       // from a stop to wheels at rest
inline constexpr Duration kStandstillDwell = 50ms;       // a wheel rests when it has not moved for so long
inline constexpr auto kMachineWatchdog = 5s;             // the machine is reset when the loop has stood still so long
inline constexpr Duration kInputsRead = 10ms;            // emergency stop and bumpers are read so often, besides edges
inline constexpr Duration kInputsAge = 50ms;             // a reading of them older than that counts as pressed

inline constexpr int kPlannerUnitsPerCycle = 100'000;  // in simulated time: planner work (planner/search/search.hpp)
inline constexpr int kThinkUntilPercent = 60;          // in real time: of the period, from its deadline on

static_assert(kMasterHeartbeatTimeout >= 3 * kMasterHeartbeat, "two lost heartbeats are not a dead master");
static_assert(kInputsAge >= 3 * kInputsRead, "two late readings are no emergency stop");
static_assert(kDriveHeartbeatTimeout >= 3 * kDriveHeartbeat, "two lost heartbeats are not a dead drive");

}  // namespace ivo::rates
