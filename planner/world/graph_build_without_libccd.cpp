// In place of graph_build.cpp where there is no libccd: nothing can be proved free here, so graphs come as tables.
#include "planner/world/graph.hpp"

namespace ivo::planner {

Refusal Graph::build(const SegmentedMap& /*map*/, const GraphParameters& /*parameters*/,
                     const GraphAgents& /*agents*/) noexcept {
  return {.code = RefusalCode::kNoGraphTable};
}

}  // namespace ivo::planner
