// What the robot is doing, and what that allows. Motion is earned step by step and lost by default.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "config/base/time.hpp"

namespace ivo::firmware {

/// The planner thinks while the drives start up, so the robot begins in kPlanning; kStarting is what is left of the
/// start-up when the plan is ready first.
enum class Mode : std::uint8_t {
  kPlanning,         ///< the planner runs, the drives start up
  kStarting,         ///< the plan is ready, the drives are not yet
  kAwaitingConsent,  ///< plan shown, drives ready, nobody has agreed
  kSearching,        ///< drives on, the robot moves
  kStopping,         ///< ramps down with the drives on until the wheels are at rest
  kDone,             ///< drives off; nothing leads away from here
  kFault,            ///< drives off; only an operator leads away from here, and back to consent
  kPausing,          ///< ramps down as kStopping does; then the drives go off, and consent is awaited anew
};
inline constexpr int kModes = 8;

[[nodiscard]] std::string_view name_of(Mode mode) noexcept;

struct Permissions {
  bool may_move = false;
  bool enable_drives = false;
  bool think = false;  ///< the planner runs
};
[[nodiscard]] Permissions permissions(Mode mode) noexcept;
/// Its way leads to standstill and nowhere else.
[[nodiscard]] constexpr bool ramps_down(Mode mode) noexcept {
  return mode == Mode::kStopping || mode == Mode::kPausing;
}

/// What a transition can depend on: a set of these bits.
using Conditions = std::uint16_t;
namespace condition {
inline constexpr Conditions kPlanReady = 1 << 0;    ///< there is a plan and it is shown
inline constexpr Conditions kConsent = 1 << 1;      ///< somebody has just agreed
inline constexpr Conditions kStopAsked = 1 << 2;    ///< by anybody, for any reason
inline constexpr Conditions kSearchEnded = 1 << 3;  ///< found, or the plan is driven to its end
inline constexpr Conditions kDrivesReady = 1 << 4;  ///< all four started up and without fault
inline constexpr Conditions kStandstill = 1 << 5;   ///< all four wheels at rest
inline constexpr Conditions kDrivesFault = 1 << 6;  ///< at least one drive or the bus
inline constexpr Conditions kPowerLost = 1 << 7;    ///< all four were enabled earlier in this search, and are not now
inline constexpr Conditions kStopOverdue = 1 << 8;  ///< ramping down for longer than rates::kStandstillTimeout
inline constexpr Conditions kClearAsked = 1 << 9;   ///< somebody has asked, since kFault began, to clear the fault
inline constexpr Conditions kPauseAsked = 1 << 10;  ///< to stand until consent anew
inline constexpr Conditions kAll = (1 << 11) - 1;
}  // namespace condition

/// One row of the table: in `from`, with all of `all_of` and none of `none_of`, go to `to`.
struct Transition {
  Mode from;
  Conditions all_of;
  Conditions none_of;
  Mode to;
};
/// The whole table. The first row that fits decides; without one the mode stays.
[[nodiscard]] std::span<const Transition> transitions() noexcept;
[[nodiscard]] Mode next_mode(Mode mode, Conditions conditions) noexcept;

struct ModeInputs {
  bool plan_ready = false;
  bool consent_given = false;  ///< only its change to true counts, and only while consent is awaited
  bool stop_asked = false;
  bool pause_asked = false;  ///< in this cycle; nothing remembers it
  bool clear_asked = false;  ///< in kFault it is remembered until the fault is gone
  bool search_ended = false;
  bool drives_ready = false;    ///< stays true while they are being enabled, and enabled
  bool drives_enabled = false;  ///< all four hold their speed under power
  bool drives_standstill = false;
  bool drives_fault = false;
};

/// The table with what it must remember: whether consent was held before, whether the drives were on, whether the fault
/// is to be cleared, since when it stops.
class ModeMachine {
 public:
  /// One cycle. `now` never goes back.
  Mode update(const ModeInputs& inputs, Instant now) noexcept;
  [[nodiscard]] Mode mode() const noexcept { return mode_; }

 private:
  [[nodiscard]] Conditions conditions(const ModeInputs& inputs, Instant now) const noexcept;

  Mode mode_ = Mode::kPlanning;
  bool consent_before_ = false;
  bool enabled_before_ = false;
  bool clear_asked_ = false;
  Instant stopping_since_{};
};

}  // namespace ivo::firmware
