// A request as the controller's socket takes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/web/request.hpp"

namespace ivo::firmware::web {

/// The packet, numbered `sequence`; none for what the server settles itself: the controls.
[[nodiscard]] std::optional<std::string> controller_message(const Request& request, std::uint32_t sequence);

}  // namespace ivo::firmware::web
