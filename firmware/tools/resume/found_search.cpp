#include "firmware/tools/resume/found_search.hpp"

#include <utility>

namespace ivo::firmware {

Result<FoundSearch> look_for_search(const std::string& state_path) {
  Result<FoundState> state = StateFile::read(state_path, KeptSearch::kVersion);
  if (!state) {
    return state.error();
  }
  FoundSearch found;
  found.state = std::move(state).value();
  found.there = found.state.kind != FoundState::Kind::kNone;
  if (found.state.kind == FoundState::Kind::kForeign) {
    found.fault = state_path + ": kept by another version of ivo, in form " + std::to_string(found.state.version) +
                  "; expected form " + std::to_string(KeptSearch::kVersion);
  } else if (found.there &&
             (found.state.kind == FoundState::Kind::kDamaged || !from_bytes(found.state.state, *found.kept))) {
    found.fault = state_path + ": what was kept of a search is damaged, in both copies; expected a whole one";
  }
  return found;
}

std::string age_text(std::int64_t seconds) {
  constexpr std::int64_t kMinute = 60;
  constexpr std::int64_t kHour = 60 * kMinute;
  constexpr std::int64_t kDay = 24 * kHour;
  const auto ago = [](std::int64_t count, const char* unit) { return std::to_string(count) + unit + " ago"; };
  if (seconds < 0) {
    return "at a time that this machine's calendar has not reached";
  }
  if (seconds < 2 * kMinute) {
    return ago(seconds, " s");
  }
  if (seconds < 2 * kHour) {
    return ago(seconds / kMinute, " min");
  }
  return seconds < 2 * kDay ? ago(seconds / kHour, " h") : ago(seconds / kDay, " days");
}

}  // namespace ivo::firmware
