// The documents that the controller shows, each with how often it has changed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::console {

/// From any thread.
class DocumentShelf {
 public:
  struct Copy {
    std::uint32_t revision = 0;  ///< 0: it was never put there
    std::shared_ptr<const std::string> bytes;
  };

  /// What is as it was stays as it is. Of more than kLargestDocument bytes nothing is taken, and false.
  bool put(Document document, std::string bytes);
  [[nodiscard]] Copy at(Document document) const;
  [[nodiscard]] std::uint32_t revision(Document document) const;

 private:
  mutable std::mutex mutex_;
  std::array<Copy, kDocuments> copies_;
};

[[nodiscard]] constexpr std::size_t place_of(Document document) noexcept {
  return static_cast<std::size_t>(document) - 1;
}

}  // namespace ivo::firmware::console
