// `ivo console`: asks a controller that runs, or tells it something, where it has no terminal.
#pragma once

#include <optional>
#include <string>

namespace ivo::firmware {

enum class ConsoleVerb {
  kStatus,
  kPlan,
  kAreas,
  kInit,
  kReplan,
  kEnough,
  kAccept,
  kStart,
  kConsent,
  kRefuse,
  kFound,
  kPosition,
  kPause,
  kStop,
  kClear
};

struct ConsoleOptions {
  ConsoleVerb verb = ConsoleVerb::kStatus;
  std::string socket = "/run/ivo/console.sock";  ///< the service's
  std::string agent;                             ///< of kFound and kPosition, by name
  std::optional<double> x_m;                     ///< of kPosition
  std::optional<double> y_m;
  std::string areas;  ///< GeoJSON of kAreas that takes the place of what is drawn; empty: what is drawn is shown
  bool wait = true;   ///< of kInit and kReplan: until the plan is there
};

/// Returns the exit status: 0, 1 when the controller refuses, 2 when there is none or the input is wrong.
[[nodiscard]] int console_command(const ConsoleOptions& options);

}  // namespace ivo::firmware
