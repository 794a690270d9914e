// What a slice of the search worked on. A slice is of one kind: it ends where another begins.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ivo::planner {

enum class SliceKind : std::uint8_t {
  kNone,
  kAnts,      ///< walk, for every agent a path
  kScore,     ///< exact scores of their tours
  kTrails,    ///< deposited and evaporated
  kDrafts,    ///< plans to begin the improvement with, and its return to an earlier one
  kChanges,   ///< of a route: proposed, proved free, judged
  kPathScore  ///< exact score of an improved plan
};
inline constexpr int kSliceKinds = 7;

[[nodiscard]] constexpr std::string_view name_of(SliceKind kind) noexcept {
  constexpr std::array<std::string_view, kSliceKinds> kNames{"none",   "ants",          "tour scores", "trails",
                                                             "drafts", "route changes", "plan scores"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace ivo::planner
