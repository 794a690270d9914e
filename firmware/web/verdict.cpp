#include "firmware/web/verdict.hpp"

#include <array>
#include <cstddef>

namespace ivo::firmware::web {

std::string_view name_of(Verdict verdict) noexcept {
  static constexpr std::array<std::string_view, kVerdicts> kNames{
      "accepted",     "malformed", "too_large",     "out_of_order", "replayed",       "too_often",
      "not_allowed",  "not_fresh", "no_controller", "not_asked",    "other_question", "answered",
      "out_of_range", "not_now",   "outdated",      "not_an_area",
  };
  return kNames[static_cast<std::size_t>(verdict)];
}

Verdict verdict_of(console::Verdict verdict) noexcept {
  switch (verdict) {
    case console::Verdict::kAccepted:
      return Verdict::kAccepted;
    case console::Verdict::kTooOften:
      return Verdict::kTooOften;
    case console::Verdict::kNotAsked:
      return Verdict::kNotAsked;
    case console::Verdict::kOtherQuestion:
      return Verdict::kOtherQuestion;
    case console::Verdict::kAnswered:
      return Verdict::kAnswered;
    case console::Verdict::kTooManyClients:
      return Verdict::kNoController;
    case console::Verdict::kOutOfRange:
      return Verdict::kOutOfRange;
    case console::Verdict::kNotNow:
      return Verdict::kNotNow;
    case console::Verdict::kOutdated:
      return Verdict::kOutdated;
    case console::Verdict::kNotAnArea:
      return Verdict::kNotAnArea;
    default:
      return Verdict::kMalformed;
  }
}

}  // namespace ivo::firmware::web
