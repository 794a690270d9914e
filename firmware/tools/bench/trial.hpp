// One search of a scene, timed; and many of them, a core each.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/tools/bench/scenes.hpp"
#include "firmware/tools/planner_object.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware::bench {

/// Processor time of the calling thread: what else runs on the machine takes nothing from it.
[[nodiscard]] double thread_seconds();

/// Seconds that cells, graph, prior and sight tables took; or why the planner refused, in one line.
[[nodiscard]] Result<double> prepare(planner::Planner& planner, const planner::SearchProblem& problem);

struct Found {
  planner::PlanScore score;
  double length_m = 0.0;   ///< of all paths together
  double bound_s = 0.0;    ///< nominal, for its unseen mass
  double prepare_s = 0.0;  ///< of one core
  double search_s = 0.0;   ///< of one core, to the end
};

/// Searches to the last generation. Cost: the search.
[[nodiscard]] Result<Found> search_to_end(planner::Planner& planner, const planner::SearchProblem& problem);

/// A planner a core, made at once, at most two.
class Cores {
 public:
  Cores();
  /// Calls `job(i, planner)` for each i below `count`, in any order, each on a core of its own; shows how far it is.
  void each(std::size_t count, const std::string& what, const std::function<void(std::size_t, planner::Planner&)>& job);
  [[nodiscard]] planner::Planner& first() { return *planners_.front(); }

 private:
  std::vector<std::unique_ptr<planner::Planner, PlannerDeleter>> planners_;
};

}  // namespace ivo::firmware::bench
