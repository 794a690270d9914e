// The search of one mission by colonies side by side, a thread each, on the planner's tables. At fixed generations all
// but the first learn of the best; the first goes its own way, so that more colonies never find less in as many
// generations. What they find depends on their number and the seed, never on timing.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "config/base/result.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware {

class Colonies {
 public:
  static constexpr int kMost = 16;
  /// Generations from one exchange to the next.
  static constexpr int kExchange = 10;

  /// Memory for `count` colonies, 1 to kMost: the planner's own search and one more object for each other. Refuses what
  /// this machine has no memory for. `planner` outlives this.
  [[nodiscard]] static Result<Colonies> create(planner::Planner& planner, int count);

  /// Readies the others when the planner is prepared. The first keeps the mission's seed: alone it finds what the
  /// planner finds.
  void start();

  /// A part of the search, some milliseconds long. Nothing when done.
  planner::Progress search_on();
  /// Generations that every colony has finished, and the best plan of all.
  [[nodiscard]] planner::Progress progress() const;
  /// The best plan so far of all colonies; there must be one.
  void best_plan(planner::Plan& plan) const { searches_[best()]->best_plan(plan); }

 private:
  explicit Colonies(planner::Planner& planner) : planner_(&planner), searches_{&planner.search()} {}

  [[nodiscard]] std::size_t best() const;
  [[nodiscard]] bool better(const planner::Progress& a, const planner::Progress& b) const;
  void exchange();

  planner::Planner* planner_;
  std::vector<std::unique_ptr<planner::Search>> others_;
  std::vector<planner::Search*> searches_;  // the planner's own, then the others
  int next_exchange_ = kExchange;           // generation
};

}  // namespace ivo::firmware
