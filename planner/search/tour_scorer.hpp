// The exact cost of an ant's tour: every edge's first sightings replayed (Eq. 8 and 10), in parts.
#pragma once

#include <array>
#include <cstdint>

#include "planner/search/edge_events.hpp"
#include "planner/search/expected_time.hpp"
#include "planner/search/first_sightings.hpp"
#include "planner/search/tour.hpp"
#include "planner/search/world.hpp"
#include "planner/world/view_walk.hpp"

namespace ivo::planner {

class TourScorer {
 public:
  /// `sightings` is its scratch.
  TourScorer(const World& world, FirstSightings& sightings) noexcept
      : world_(world), events_(world.cells, world.graph, world.sight), sightings_(sightings) {}

  /// Another mission; `to_end`: EST runs to the plan's own end, K = N, as the paper has it. Cost: the edges.
  void open(bool to_end) noexcept {
    to_end_ = to_end;
    events_.clear();
  }

  /// Makes the events of the edges beforehand, of as many as there is room for: the search then finds them ready. Cost:
  /// each edge's cells.
  void warm() noexcept;

  /// `tour` lasts until done().
  void start(Tour& tour, double max_unseen_mass) noexcept;
  /// Up to about `rows` table rows. Returns the work done.
  int advance(int rows) noexcept;
  [[nodiscard]] bool done() const noexcept { return phase_ == Phase::kDone; }

 private:
  enum class Phase : std::uint8_t { kClear, kReplay, kSum, kDone };

  int clear(int rows) noexcept;
  int replay(int rows) noexcept;
  int look_from_start(int rows) noexcept;
  int time_points(Edge e) noexcept;
  int sum(int rows) noexcept;
  void begin_agent(int agent) noexcept;
  void finish() noexcept;

  const World& world_;
  EdgeEvents events_;
  FirstSightings& sightings_;
  ExpectedTime expected_;
  Tour* tour_ = nullptr;
  double max_unseen_mass_ = 0.0;
  bool to_end_ = false;
  Phase phase_ = Phase::kDone;
  int agent_ = 0;
  ViewWalk from_start_;
  std::size_t edge_ = 0;
  Node at_ = 0;
  Seconds time_s_{};
  int row_ = 0;
  struct Instant {
    Seconds time_s{};
    std::int32_t step = 0;
  };
  std::array<Instant, SightTable::kMaxPoint + 1> instants_{};  // of the edge under way, by sight point
};

}  // namespace ivo::planner
