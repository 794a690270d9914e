// What became of a request, in the words of protocol.md.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::web {

enum class Verdict : std::uint8_t {
  kAccepted,
  // The server's own.
  kMalformed,
  kTooLarge,
  kOutOfOrder,
  kReplayed,
  kTooOften,
  kNotAllowed,    ///< does not hold the controls, or may only look
  kNotFresh,      ///< the link of who would start is not fresh enough
  kNoController,  ///< it is not there, or went before it answered
  // The controller's.
  kNotAsked,
  kOtherQuestion,
  kAnswered,
  kOutOfRange,
  kNotNow,
  kOutdated,
  kNotAnArea,
};
inline constexpr int kVerdicts = 16;

[[nodiscard]] std::string_view name_of(Verdict verdict) noexcept;  ///< "out_of_order"
/// Of what the controller says to us; what it should never have to say is kMalformed, but for its rate.
[[nodiscard]] Verdict verdict_of(console::Verdict verdict) noexcept;

}  // namespace ivo::firmware::web
