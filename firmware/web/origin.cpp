#include "firmware/web/origin.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace ivo::firmware::web {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

std::string without_port(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const bool has_port = colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos;
  return lower_case(has_port ? host.substr(0, colon) : host);
}

/// With the port that a browser leaves out.
std::string with_port(std::string_view host, bool tls) {
  const std::string name = without_port(host);
  return name.size() == host.size() ? name + (tls ? ":443" : ":80") : lower_case(host);
}

bool is_address(const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> room{};
  const bool six = name.size() > 2 && name.front() == '[' && name.back() == ']';
  return ::inet_pton(six ? AF_INET6 : AF_INET, (six ? name.substr(1, name.size() - 2) : name).c_str(), room.data()) ==
         1;
}

}  // namespace

bool same_origin(std::string_view origin, std::string_view host, bool tls, const std::vector<std::string>& others) {
  const std::string_view scheme = tls ? "https://" : "http://";
  if (!host.empty() && origin.size() > scheme.size() && lower_case(origin.substr(0, scheme.size())) == scheme &&
      with_port(origin.substr(scheme.size()), tls) == with_port(host, tls)) {
    return true;
  }
  return std::any_of(others.begin(), others.end(), [&](const std::string& other) {
    return !origin.empty() && lower_case(other) == lower_case(origin);
  });
}

bool own_host(std::string_view host, std::string_view machine, const std::vector<std::string>& others) {
  const std::string name = without_port(host);
  const std::string own = lower_case(machine);
  if (name == "localhost" || is_address(name) || (!own.empty() && (name == own || name == own + ".local"))) {
    return true;
  }
  return std::any_of(others.begin(), others.end(), [&](const std::string& other) {
    const std::size_t scheme = other.find("://");
    return !name.empty() && scheme != std::string::npos && without_port(other.substr(scheme + 3)) == name;
  });
}

bool is_this_machine(std::string_view host) {
  const std::string name = without_port(host);
  return name == "localhost" || name == "[::1]" ||
         (name.starts_with("127.") && name.find_first_not_of("0123456789.") == std::string::npos);
}

}  // namespace ivo::firmware::web
