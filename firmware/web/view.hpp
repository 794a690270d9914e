// What the server knows of the controller, and how old that is: the source of everything that a page or a ROS client
// is shown.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "config/base/time.hpp"
#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::web {

enum class LinkState : std::uint8_t {
  kNone,       ///< never seen
  kConnected,  //
  kSilent,     ///< nothing heard for a second
  kAbsent,     ///< not there; all else is what was known last
};

struct KnownDocument {
  /// Grows with each change of any document, also when another controller begins to count anew; 0: never came.
  std::uint32_t revision = 0;
  std::shared_ptr<const std::string> bytes;  ///< whole; null as long as it never came, "" where there is none

  [[nodiscard]] bool there() const noexcept { return bytes != nullptr && !bytes->empty(); }
};

/// Read by one thread, the server's. A copy shares the documents.
struct View {
  LinkState link = LinkState::kNone;
  Instant heard_at{};             ///< the controller's last word; meaningless in kNone
  std::uint64_t statuses = 0;     ///< how many came: another number, another status
  std::uint64_t connections = 0;  ///< how often a controller was connected to: another number, another run perhaps
  std::optional<console::Status> status;  ///< the newest
  std::array<KnownDocument, console::kDocuments> documents;

  [[nodiscard]] const KnownDocument& document(console::Document which) const noexcept {
    return documents[static_cast<std::size_t>(which) - 1];
  }
};

}  // namespace ivo::firmware::web
