// The command line of ivo-console.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/web/server.hpp"
#include "firmware/web/token_store.hpp"

namespace ivo::firmware::web {

struct ConsoleOptions {
  std::string socket = "/run/ivo/console.sock";  ///< the service's, as of ivo console
  Listening listening;
  std::string page;  ///< folder
  std::string leaflet = "/usr/share/javascript/leaflet";
  std::string state;  ///< folder
  std::vector<std::string> origins;
  std::optional<std::string> new_token;  ///< a name: print a token for it and end
  Role role = Role::kViewer;             ///< of the new token
  bool paired = false;                   ///< print who is paired and end
  std::optional<std::string> forget;     ///< of whom, and end
  bool help = false;
};

/// What the environment adds: where the program lies, and where a user's programs keep their state.
struct ConsolePlaces {
  std::string program_folder;
  std::string state_home;  ///< $XDG_STATE_HOME; empty: a service's folder
};

/// Refuses an option that is not known, has no value or a wrong one, or does not go with another, by its name.
[[nodiscard]] Result<ConsoleOptions> parse_console_options(std::span<const char* const> arguments,
                                                           const ConsolePlaces& places);
[[nodiscard]] std::string console_usage();

}  // namespace ivo::firmware::web
