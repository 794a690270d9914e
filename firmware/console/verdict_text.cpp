#include "firmware/console/verdict_text.hpp"

#include <array>
#include <cstddef>

namespace ivo::firmware::console {

std::string_view name_of(Verdict verdict) noexcept {
  static constexpr std::array<std::string_view, kVerdicts> kNames{
      "accepted",
      "of a wrong size",
      "without the magic number",
      "of another version",
      "of an unknown kind",
      "with a field that is to be 0",
      "sent twice",
      "out of order",
      "too often",
      "not asked for now",
      "an answer to another question than is asked now",
      "answered already",
      "from a client too many",
      "with a number out of range",
      "not possible now",
      "about a plan or areas that are not the newest",
      "not an area",
  };
  const auto number = static_cast<std::size_t>(verdict);
  return number < kNames.size() ? kNames[number] : "refused for a reason that this program does not know";
}

}  // namespace ivo::firmware::console
