// Does something restart the machine when it hangs?
#pragma once

#include <optional>
#include <string>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

/// The device, and whether systemd feeds it (RuntimeWatchdogSec= of its configuration).
[[nodiscard]] Group watchdog_checks(const MachineFiles& files);

/// RuntimeWatchdogSec= as systemd reads it (systemd-system.conf(5)): of the last of its files that sets it; none where
/// none does. Drop-ins come after system.conf, by name; /etc hides /run, and that /usr/local/lib and /usr/lib.
[[nodiscard]] std::optional<std::string> runtime_watchdog(const MachineFiles& files);

/// A time span of systemd.time(7) in seconds, as "30", "1min 30s", "500ms"; 0 for "off" or nothing; none of "default",
/// "infinity" and what is no span.
[[nodiscard]] std::optional<double> span_s(const std::string& text);

}  // namespace ivo::firmware::doctor
