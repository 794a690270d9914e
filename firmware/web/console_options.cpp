#include "firmware/web/console_options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <utility>

namespace ivo::firmware::web {
namespace {

struct Option {
  std::string_view name;
  std::string_view value;
  std::string_view meaning;
};
constexpr std::array<Option, 13> kOptions{{
    {"--socket", "PATH", "of the controller, as given to ivo run --console (the service's)"},
    {"--listen", "ADDRESS", "of this machine (127.0.0.1); 0.0.0.0 or :: for all of them"},
    {"--port", "N", "TCP port (8080); 0: any that is free"},
    {"--certificate", "FILE", "with --key: TLS, and https:// for the page"},
    {"--key", "FILE", "of the certificate"},
    {"--origin", "URL", "of another page that may use this server, as http://tablet:8000; may be given again"},
    {"--web", "DIR", "the page's files (web beside this program, or where the package puts them)"},
    {"--leaflet", "DIR", "Leaflet's files (/usr/share/javascript/leaflet)"},
    {"--state", "DIR", "where it keeps who is paired ($XDG_STATE_HOME/ivo-console, or /var/lib/ivo-console)"},
    {"--new-token", "NAME", "print a token for a ROS client or a script, and end"},
    {"--role", "ROLE", "of that token: viewer, who may look and stop, or operator"},
    {"--paired", "", "print who is paired, oldest first, each with its digits, and end"},
    {"--forget", "DIGITS", "end the pairing of whom --paired shows with them, and end"},
}};

Error refusal(std::string_view name, std::string_view found, std::string_view expected) {
  return Error{std::string(name) + ": \"" + std::string(found) + "\" will not do; expected " + std::string(expected)};
}

Result<void> set(std::string_view name, const std::string& value, ConsoleOptions& options) {
  if (value.empty()) {
    return refusal(name, value, "a value");
  }
  const std::array<std::pair<std::string_view, std::string*>, 7> texts{{
      {"--socket", &options.socket},
      {"--listen", &options.listening.address},
      {"--certificate", &options.listening.certificate},
      {"--key", &options.listening.key},
      {"--web", &options.page},
      {"--leaflet", &options.leaflet},
      {"--state", &options.state},
  }};
  for (const auto& [known, text] : texts) {
    if (name == known) {
      *text = value;
      return {};
    }
  }
  if (name == "--port") {
    constexpr int kMost = 65'535;
    int port = -1;
    const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), port);
    if (status != std::errc() || end != value.data() + value.size() || port < 0 || port > kMost) {
      return refusal(name, value, "a port, 0 to 65535");
    }
    options.listening.port = port;
  } else if (name == "--origin") {
    const bool right = (value.starts_with("http://") || value.starts_with("https://")) && !value.ends_with('/');
    if (!right) {
      return refusal(name, value, "http:// or https://, a host and perhaps a port");
    }
    options.origins.push_back(value);
  } else if (name == "--new-token") {
    options.new_token = value;
  } else if (name == "--forget") {
    options.forget = value;
  } else {
    const std::optional<Role> role = role_of(value);
    if (!role) {
      return refusal(name, value, "viewer or operator");
    }
    options.role = *role;
  }
  return {};
}

bool is_known(std::string_view name) {
  for (const Option& option : kOptions) {
    if (name == option.name) {
      return true;
    }
  }
  return false;
}

}  // namespace

Result<ConsoleOptions> parse_console_options(std::span<const char* const> arguments, const ConsolePlaces& places) {
  ConsoleOptions options;
  // Installed, or in the folder that it was built in.
  options.page =
      places.program_folder + (places.program_folder.ends_with("/bin") ? "/../share/ivo-console/web" : "/web");
  options.state = places.state_home.empty() ? "/var/lib/ivo-console" : places.state_home + "/ivo-console";
  bool role_said = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string argument = arguments[i];
    if (argument == "--help" || argument == "-h") {
      options.help = true;
      return options;
    }
    const std::size_t equals = argument.starts_with("--") ? argument.find('=') : std::string::npos;
    const std::string name = argument.substr(0, equals);
    if (!is_known(name)) {
      return Error{"\"" + name + "\" is no option; expected one that ivo-console --help shows"};
    }
    if (name == "--paired") {
      if (equals != std::string::npos) {
        return refusal(name, argument.substr(equals + 1), "no value");
      }
      options.paired = true;
      continue;
    }
    if (equals == std::string::npos && i + 1 == arguments.size()) {
      return Error{name + ": has no value; expected one behind it"};
    }
    const std::string value = equals == std::string::npos ? arguments[++i] : argument.substr(equals + 1);
    if (const Result<void> done = set(name, value, options); !done) {
      return done.error();
    }
    role_said = role_said || name == "--role";
  }
  if (options.listening.certificate.empty() != options.listening.key.empty()) {
    return Error{"--certificate and --key: one is given without the other; expected both or none"};
  }
  if (role_said != options.new_token.has_value()) {
    return Error{"--new-token and --role: one is given without the other; expected both or none"};
  }
  return options;
}

std::string console_usage() {
  std::string text =
      "usage: ivo-console [OPTION...]\nServes the console's page, and ROS clients, beside a running controller.\n\n";
  for (const Option& option : kOptions) {
    std::string left = "  " + std::string(option.name) + " " + std::string(option.value);
    constexpr std::size_t kColumn = 24;
    left.resize(std::max(left.size() + 1, kColumn), ' ');
    text += left + std::string(option.meaning) + "\n";
  }
  return text;
}

}  // namespace ivo::firmware::web
