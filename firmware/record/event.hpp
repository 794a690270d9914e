// What happens in a run, as fixed-size events: the loop writes them into a ring, the event log outside the loop into a
// file.
#pragma once

#include <cstdint>

#include "config/base/spsc_ring.hpp"
#include "config/base/time.hpp"

namespace ivo::firmware {

enum class EventKind : std::uint8_t {
  kMode,           ///< code: Mode entered
  kPlanImproved,   ///< code: generation; x: expected time s, y: unseen mass
  kPlanReady,      ///< code: generations
  kConsent,        ///< a person agreed to the plans
  kStopAsked,      ///< code: StopCause
  kSearchStarted,  //
  kPosition,       ///< agent; x, y: m
  kFound,          ///< agent; x, y: where the object lay
  kPathsEnded,     //
  kDriveFault,     ///< agent: wheel; code: DriveFaultReason
  kOverrun,        ///< code: periods skipped; agent: Lateness
  kBusState,       ///< code: hal::BusState, changed
  kFaultCleared,   ///< by the operator; the drives start up again
  kPaused,         ///< code: PauseCause
  kPlanAsked,      ///< code: number of the plan that is made anew
  kPlanTaken,      ///< under way: code: number of the plan that is followed from here on
};

struct Event {
  Instant at{};
  EventKind kind = EventKind::kMode;
  std::uint8_t agent = 0;
  std::int32_t code = 0;
  double x = 0.0;
  double y = 0.0;
};

using EventRing = SpscRing<Event, 4096>;

}  // namespace ivo::firmware
