#include "firmware/safety/mode.hpp"

#include <array>
#include <cstddef>

#include "config/rates.hpp"

namespace ivo::firmware {
namespace {

struct ModeRow {
  std::string_view name;
  Permissions permissions;
};

constexpr std::array<ModeRow, kModes> kModeRows{{
    {"planning", {.may_move = false, .enable_drives = false, .think = true}},
    {"starting", {.may_move = false, .enable_drives = false, .think = false}},
    {"awaiting consent", {.may_move = false, .enable_drives = false, .think = false}},
    {"searching", {.may_move = true, .enable_drives = true, .think = false}},
    {"stopping", {.may_move = true, .enable_drives = true, .think = false}},
    {"done", {.may_move = false, .enable_drives = false, .think = false}},
    {"fault", {.may_move = false, .enable_drives = false, .think = false}},
    {"pausing", {.may_move = true, .enable_drives = true, .think = false}},
}};

using namespace condition;

constexpr auto kTransitions = std::to_array<Transition>({
    {Mode::kPlanning, kDrivesFault, 0, Mode::kFault},
    {Mode::kPlanning, kStopAsked, 0, Mode::kDone},
    {Mode::kPlanning, kSearchEnded, 0, Mode::kDone},  // by somebody else, while a plan was made anew
    {Mode::kPlanning, kPlanReady | kDrivesReady, 0, Mode::kAwaitingConsent},
    {Mode::kPlanning, kPlanReady, 0, Mode::kStarting},

    {Mode::kStarting, kDrivesFault, 0, Mode::kFault},
    {Mode::kStarting, kStopAsked, 0, Mode::kDone},
    {Mode::kStarting, kSearchEnded, 0, Mode::kDone},  // by somebody else, while a fault was cleared
    {Mode::kStarting, 0, kPlanReady, Mode::kPlanning},
    {Mode::kStarting, kDrivesReady, 0, Mode::kAwaitingConsent},

    {Mode::kAwaitingConsent, kDrivesFault, 0, Mode::kFault},
    {Mode::kAwaitingConsent, kStopAsked, 0, Mode::kDone},
    {Mode::kAwaitingConsent, kSearchEnded, 0, Mode::kDone},
    {Mode::kAwaitingConsent, 0, kPlanReady, Mode::kPlanning},
    {Mode::kAwaitingConsent, 0, kDrivesReady, Mode::kStarting},
    {Mode::kAwaitingConsent, kConsent, 0, Mode::kSearching},

    {Mode::kSearching, kDrivesFault, 0, Mode::kFault},
    // A drive that lost power must not move on its own when it has it back.
    {Mode::kSearching, kPowerLost, 0, Mode::kFault},
    {Mode::kSearching, 0, kDrivesReady, Mode::kFault},
    {Mode::kSearching, kStopAsked, 0, Mode::kStopping},
    {Mode::kSearching, kSearchEnded, 0, Mode::kStopping},
    {Mode::kSearching, kPauseAsked, 0, Mode::kPausing},

    {Mode::kStopping, kDrivesFault, 0, Mode::kFault},
    {Mode::kStopping, kStandstill, 0, Mode::kDone},
    {Mode::kStopping, kPowerLost, 0, Mode::kFault},
    {Mode::kStopping, kStopOverdue, 0, Mode::kFault},

    {Mode::kPausing, kDrivesFault, 0, Mode::kFault},
    {Mode::kPausing, kStopAsked, 0, Mode::kStopping},
    {Mode::kPausing, kSearchEnded, 0, Mode::kStopping},
    {Mode::kPausing, kStandstill, 0, Mode::kStarting},
    {Mode::kPausing, kPowerLost, 0, Mode::kFault},
    {Mode::kPausing, kStopOverdue, 0, Mode::kFault},

    // The drives' own fault goes first. What follows is as at the beginning: drives ready, then consent.
    {Mode::kFault, kClearAsked, kDrivesFault | kStopAsked, Mode::kStarting},
});

const ModeRow& row_of(Mode mode) noexcept { return kModeRows[static_cast<std::size_t>(mode)]; }

constexpr Conditions bit_if(bool holds, Conditions bit) noexcept { return holds ? bit : Conditions{0}; }

}  // namespace

std::string_view name_of(Mode mode) noexcept { return row_of(mode).name; }

Permissions permissions(Mode mode) noexcept { return row_of(mode).permissions; }

std::span<const Transition> transitions() noexcept { return kTransitions; }

Mode next_mode(Mode mode, Conditions conditions) noexcept {
  for (const Transition& row : kTransitions) {
    if (row.from == mode && (conditions & row.all_of) == row.all_of && (conditions & row.none_of) == 0) {
      return row.to;
    }
  }
  return mode;
}

Mode ModeMachine::update(const ModeInputs& inputs, Instant now) noexcept {
  const Mode before = mode_;
  mode_ = next_mode(before, conditions(inputs, now));
  clear_asked_ = mode_ == Mode::kFault && before == Mode::kFault && (clear_asked_ || inputs.clear_asked);
  if (mode_ != before && ramps_down(mode_)) {
    stopping_since_ = now;
  }
  enabled_before_ = permissions(mode_).enable_drives && (enabled_before_ || inputs.drives_enabled);
  consent_before_ = inputs.consent_given;
  return mode_;
}

Conditions ModeMachine::conditions(const ModeInputs& inputs, Instant now) const noexcept {
  const bool overdue = ramps_down(mode_) && now - stopping_since_ > rates::kStandstillTimeout;
  Conditions set = 0;
  set |= bit_if(inputs.plan_ready, kPlanReady);
  set |= bit_if(inputs.consent_given && !consent_before_, kConsent);
  set |= bit_if(inputs.stop_asked, kStopAsked);
  set |= bit_if(inputs.search_ended, kSearchEnded);
  set |= bit_if(inputs.drives_ready, kDrivesReady);
  set |= bit_if(inputs.drives_standstill, kStandstill);
  set |= bit_if(inputs.drives_fault, kDrivesFault);
  set |= bit_if(enabled_before_ && !inputs.drives_enabled, kPowerLost);
  set |= bit_if(overdue, kStopOverdue);
  set |= bit_if(mode_ == Mode::kFault && (clear_asked_ || inputs.clear_asked), kClearAsked);
  set |= bit_if(inputs.pause_asked, kPauseAsked);
  return set;
}

}  // namespace ivo::firmware
