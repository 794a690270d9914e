// The program's planner.
#pragma once

#include "planner/search/planner.hpp"

namespace ivo::firmware {

/// The largest object of the product: static, so that its pages are there from the start and belong to nobody's heap.
[[nodiscard]] planner::Planner& the_planner();

}  // namespace ivo::firmware
