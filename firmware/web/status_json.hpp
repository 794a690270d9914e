// What is known, as the JSON texts of protocol.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/time.hpp"
#include "firmware/web/controls.hpp"
#include "firmware/web/layer.hpp"
#include "firmware/web/refusals.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

/// A connection, as others see it.
struct ScreenEntry {
  Screen screen = 0;
  std::string name;
  bool ros = false;
};

/// What the server itself adds to what it knows of the controller.
struct Desk {
  std::optional<Screen> holder;
  std::optional<Screen> requester;
  std::vector<ScreenEntry> screens;
  Refusals refusals;
};

/// Without its last members: these are each screen's own, and status_text() adds them.
[[nodiscard]] std::string common_status(const View& view, const Desk& desk, Instant now);
[[nodiscard]] std::string status_text(const std::string& common, bool start_fresh, std::uint32_t number);

[[nodiscard]] std::string hello_text(Screen screen, std::string_view name, bool may_operate);
[[nodiscard]] std::string answer_text(std::uint32_t sequence, Verdict verdict);
/// `value` is JSON; empty: there is none.
[[nodiscard]] std::string document_text(std::string_view name, std::uint32_t revision, std::string_view value);
[[nodiscard]] std::string grid_text(std::string_view name, std::uint32_t revision);
[[nodiscard]] std::string layer_text(const Layer& layer, Instant now);

/// {"error":"wrong_code","left":4}; without a number nothing follows the code.
[[nodiscard]] std::string error_text(std::string_view code);
[[nodiscard]] std::string error_text(std::string_view code, std::string_view name, int number);

}  // namespace ivo::firmware::web
