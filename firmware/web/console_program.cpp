#include "firmware/web/console_program.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <utility>

#include "firmware/web/http_desk.hpp"
#include "firmware/web/hub.hpp"
#include "firmware/web/pairing_code.hpp"
#include "firmware/web/site.hpp"
#include "hal/linux/service_notify.hpp"

namespace ivo::firmware::web {
namespace {

constexpr Duration kAliveEvery = std::chrono::seconds(1);

std::string place_text(const Listening& listening, int port) {
  const bool six = listening.address.find(':') != std::string::npos;
  return std::string(listening.certificate.empty() ? "http://" : "https://") +
         (six ? "[" + listening.address + "]" : listening.address) + ":" + std::to_string(port) + "/";
}

std::string machine_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string line_of(const Paired& paired) {
  return paired.hash.substr(0, TokenStore::kIdDigits) + " " + std::string(name_of(paired.role)) + " " + paired.name +
         "\n";
}

}  // namespace

Result<void> run_console(const ConsoleOptions& options, const std::atomic<bool>& stop, std::ostream& out) {
  Result<TokenStore> tokens = TokenStore::open(options.state);
  if (!tokens) {
    return tokens.error();
  }
  if (options.new_token) {
    const Result<std::string> token = tokens.value().add(*options.new_token, options.role);
    if (!token) {
      return token.error();
    }
    out << token.value() << '\n';
    return {};
  }
  if (options.forget) {
    const Result<Paired> forgotten = tokens.value().forget(*options.forget);
    if (!forgotten) {
      return Error{"--forget: " + forgotten.error().message};
    }
    out << "forgotten: " << line_of(forgotten.value());
    return {};
  }
  if (options.paired) {
    for (const Paired& paired : tokens.value().all()) {
      out << line_of(paired);
    }
    out << (tokens.value().size() == 0 ? "nobody is paired\n" : "");
    return {};
  }
  const Result<Site> site = Site::read(options.page, options.leaflet);
  if (!site) {
    return site.error();
  }
  Result<hal::ServiceNotify> notify = hal::ServiceNotify::open();
  if (!notify) {
    return notify.error();
  }
  const auto say = [&out](const std::string& line) { out << line << std::endl; };
  PairingCode code;
  Hub hub(options.socket, say);
  HttpDesk desk(site.value(), hub, tokens.value(), code,
                {.tls = !options.listening.certificate.empty(), .origins = options.origins, .machine = machine_name()},
                say);
  Result<Server> server = Server::listen(options.listening, hub, desk, say);
  if (!server) {
    return server.error();
  }
  say("listening at " + place_text(options.listening, server.value().port()));
  say("the pairing code is " + code.digits());
  notify.value().ready();
  server.value().run(stop, [&notify, said_at = Instant()]() mutable {
    const Instant now(std::chrono::steady_clock::now().time_since_epoch());
    if (now - said_at >= kAliveEvery) {
      said_at = now;
      notify.value().alive();
    }
  });
  notify.value().stopping();
  say("ended");
  return {};
}

}  // namespace ivo::firmware::web
