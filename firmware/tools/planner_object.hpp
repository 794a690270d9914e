// The program's planner, and others beside it.
#pragma once

#include <memory>

#include "planner/search/planner.hpp"

namespace ivo::firmware {

/// The largest object of the product: static, so that it belongs to nobody's heap.
[[nodiscard]] planner::Planner& the_planner();

struct PlannerDeleter {
  void operator()(planner::Planner* planner) const noexcept;
};
/// Another, on the heap, for who searches beside it.
[[nodiscard]] std::unique_ptr<planner::Planner, PlannerDeleter> make_planner();

}  // namespace ivo::firmware
