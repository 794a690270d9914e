// The MAX-MIN ant system with a trail matrix for each agent (paper, "Sub-prior MTS-ACO"; model.md, "Search (MMAS)"), in
// parts of bounded work. An ant's exact cost is worked out only where its bounds leave open whether it matters: the
// decisions are those of scoring every ant.
#pragma once

#include <array>
#include <cstdint>

#include "planner/search/ant.hpp"
#include "planner/search/tour_scorer.hpp"

namespace ivo::planner {

enum class Profile : std::uint8_t {
  kPaper,  ///< the paper's MMAS on Eq. 8 or EST
  kFast,   ///< the default: a short MMAS, then iterated improvement of its plan, off the graph too, on ET_c or EST
};

/// Symbols as in model.md, "Search (MMAS)"; alpha is 1.
struct ColonyParameters {
  Profile profile = Profile::kFast;
  Heuristic heuristic = Heuristic::kTsp;
  int generations = 300;
  int ants = 10;
  int beta = 6;
  double rho = 0.002;
  int restart_after = 0;        ///< generations without a better plan before all trails are equal again; 0: never
  double iteration_best = 0.5;  ///< probability that the generation's best deposits, not the best so far
  AntParameters ant;
  std::uint64_t seed = 1;
};

class Colony {
 public:
  Colony(const World& world, FirstSightings& sightings) noexcept
      : world_(world), ant_(world, trails_), scorer_(world, sightings) {}

  /// Another mission. Cost: cells and edges.
  void start(const ColonyParameters& parameters) noexcept;

  /// A part of the work, about `rows` units at most. Returns the work done. Nothing when done.
  int advance(int rows) noexcept;

  [[nodiscard]] bool done() const noexcept { return phase_ == Phase::kDone; }
  [[nodiscard]] int generation() const noexcept { return generation_; }  ///< finished
  [[nodiscard]] int generations() const noexcept { return parameters_.generations; }
  [[nodiscard]] bool has_best() const noexcept { return has_best_; }
  /// The best tour so far, scored: complete ones by cost, before incomplete ones by unseen mass.
  [[nodiscard]] const Tour& best() const noexcept { return best_; }

  /// From another colony on the same tables: takes its best when it is better, at the end of a generation.
  void offer(const Tour& tour) noexcept;

  /// Edges walked by ants since start().
  [[nodiscard]] std::int64_t moves() const noexcept { return ant_.moves(); }

  /// What the last part worked on; slices are compared within a kind.
  enum class Phase : std::uint8_t { kAnt, kScoreBest, kScoreAnt, kRaise, kEvaporate, kClamp, kDone };
  [[nodiscard]] Phase phase() const noexcept { return phase_; }

 private:
  int end_ant() noexcept;
  int contend() noexcept;
  void drop_the_beaten() noexcept;
  int begin_generation() noexcept;
  int begin_ant() noexcept;
  int end_generation() noexcept;
  int take_generation_best() noexcept;
  int deposit() noexcept;
  int sweep_trails(int rows) noexcept;
  void score(Tour& tour, Phase phase) noexcept;
  [[nodiscard]] bool better(const Tour& a, const Tour& b) const noexcept;
  [[nodiscard]] bool better_to_show(const Tour& a, const Tour& b) const noexcept;
  void set_best(const Tour& tour) noexcept;

  const World& world_;
  Trails trails_;
  Ant ant_;
  TourScorer scorer_;

  ColonyParameters parameters_;
  Rng rng_;
  Rng deposit_rng_;  // of its own: who deposits is known before the ants set out
  Phase phase_ = Phase::kDone;
  int generation_ = 0;
  int bettered_ = 0;   // generation of the best so far, or of the last restart
  int ants_done_ = 0;  // of this generation
  bool deposits_iteration_best_ = false;
  int sweep_agent_ = 0;
  Edge sweep_edge_ = 0;
  bool has_best_ = false;
  static constexpr int kContenders = 4;
  std::array<Tour, kContenders> contenders_;  // of this generation, in the order of the ants
  int contending_ = 0;
  Tour generation_best_;
  Tour best_;
};

}  // namespace ivo::planner
