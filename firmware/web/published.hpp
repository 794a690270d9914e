// The controller's documents as pages are told of them: composed once, for all.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "firmware/console/console_messages.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

class Published {
 public:
  struct Message {
    std::uint32_t revision = 0;               ///< 0: it never came
    std::shared_ptr<const std::string> text;  ///< of the document, or that there is a new grid; empty: nothing to tell
  };

  /// Composes what is new. Cost: to parse it; a text that is no JSON is as good as none.
  void update(const View& view);
  /// In the order in which a page is told.
  [[nodiscard]] const std::array<Message, console::kDocuments>& messages() const noexcept { return messages_; }

 private:
  std::array<Message, console::kDocuments> messages_;
};

/// "previous_plan"
[[nodiscard]] std::string_view name_of(console::Document document) noexcept;

}  // namespace ivo::firmware::web
