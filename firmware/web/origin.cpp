#include "firmware/web/origin.hpp"

#include <algorithm>
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

bool is_this_machine(std::string_view host) {
  const std::string name = without_port(host);
  return name == "localhost" || name == "[::1]" ||
         (name.starts_with("127.") && name.find_first_not_of("0123456789.") == std::string::npos);
}

}  // namespace ivo::firmware::web
