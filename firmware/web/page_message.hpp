// A message of a page, read strictly: protocol.md, "From the page". Any bytes may come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware/web/request.hpp"
#include "firmware/web/verdict.hpp"

namespace ivo::firmware::web {

struct PageMessage {
  static constexpr std::size_t kLongest = 8192;  ///< bytes

  Verdict verdict = Verdict::kMalformed;  ///< or kTooLarge, or kAccepted: the form is right
  std::uint32_t sequence = 0;             ///< as it claims; 0: it claims none that can be
  Request request;                        ///< of an accepted one
};

/// Cost: to parse at most kLongest bytes.
[[nodiscard]] PageMessage page_message(std::string_view text);

}  // namespace ivo::firmware::web
