// May a request come from a page of that origin? A browser says where a page is from; nobody but ours may use its
// cookie.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ivo::firmware::web {

/// `origin`, as "http://robot.local:8080", is of the host that the request was sent to, `host` as "robot.local:8080";
/// or it is among `others`. An empty one never is.
[[nodiscard]] bool same_origin(std::string_view origin, std::string_view host, bool tls,
                               const std::vector<std::string>& others);

/// May a request that changes something be sent to that host? A stranger's page may turn a name of its own towards this
/// machine, and is of the same origin then; it cannot so turn an address, or a name that is ours: `machine`,
/// `machine`.local, localhost, or the host of one of `others`.
[[nodiscard]] bool own_host(std::string_view host, std::string_view machine, const std::vector<std::string>& others);

/// "localhost:8080", "127.0.0.1", "[::1]:8080".
[[nodiscard]] bool is_this_machine(std::string_view host);

}  // namespace ivo::firmware::web
