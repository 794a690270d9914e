// Puts a document's parts together, as they come from the controller; believes none of their numbers.
#pragma once

#include <cstdint>
#include <string>

#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::console {

/// Of one document.
class DocumentAssembly {
 public:
  enum class Outcome : std::uint8_t {
    kMore,     ///< more is to come
    kWhole,    ///< take() gives it
    kRefused,  ///< not a part that can follow; what was there is dropped
  };

  /// Cost: a copy of the part.
  [[nodiscard]] Outcome add(const DocumentPart& part);
  /// The whole document, once, after kWhole.
  [[nodiscard]] std::string take();

 private:
  std::uint32_t revision_ = 0;
  std::uint32_t whole_ = 0;
  std::string bytes_;
};

}  // namespace ivo::firmware::console
