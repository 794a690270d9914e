#include "config/limits.hpp"
#include "planner/search/planner.hpp"

namespace ivo::planner {

static_assert(sizeof(Planner) <= limits::kPlannerBytes, "the planner is over its profile's memory (config/limits.hpp)");

std::span<const Planner::Part> Planner::parts() noexcept {
  static constexpr Part kParts[] = {
      {"cells", sizeof(cells_)},           {"graph", sizeof(graph_)},
      {"prior", sizeof(raw_mass_)},        {"belief", sizeof(belief_)},
      {"sight", sizeof(sight_)},           {"bounds", sizeof(bounds_)},
      {"paces", sizeof(paces_)},           {"sightings", sizeof(search_.sightings_)},
      {"colony", sizeof(search_.colony_)}, {"improver", sizeof(search_.improver_)},
  };
  // Whoever adds a member adds it here.
  constexpr std::size_t kSmall = 262'144;
  constexpr std::size_t kNamed = [] {
    std::size_t sum = 0;
    for (const Part& part : kParts) {
      sum += part.bytes;
    }
    return sum;
  }();
  static_assert(sizeof(Planner) - kNamed <= kSmall, "a large member of the planner is missing from its parts");
  return kParts;
}

}  // namespace ivo::planner
