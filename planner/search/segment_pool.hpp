// Straight moves between any two places, with what is seen along each: the stuff that improved plans are made of. A
// segment keeps its sight as swaths of one word a row, each over a short part of the way; they are made from a half-width a
// row, so that a segment costs a microsecond where nothing hides, and rays only elsewhere. Good for judging a change, not
// for the score that a plan is shown with (path_score.hpp).
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/lattice.hpp"
#include "planner/world/clearance_map.hpp"
#include "planner/world/graph.hpp"
#include "planner/world/polygon.hpp"
#include "planner/world/sight_table.hpp"

namespace ivo::planner {

/// Who moves: what decides whether a segment is free and what is seen along it.
struct Body {
  AgentKind kind = AgentKind::kRobot;
  double footprint_radius_m = 0.30;
  double sight_radius_m = 2.5;
  Areas restricted;

  /// A segment of one is good for the other.
  [[nodiscard]] bool like(const Body& other) const noexcept {
    return kind == other.kind && footprint_radius_m == other.footprint_radius_m &&
           sight_radius_m == other.sight_radius_m && restricted.empty() && other.restricted.empty();
  }
};
using Bodies = StaticVector<Body, limits::kAgents>;

/// What is seen from a short part of a segment: as a Swath, with its words.
struct Part {
  static constexpr int kRows = 48;
  std::int32_t first_row = 0;
  std::int32_t first_byte = 0;
  std::int32_t next = -1;  ///< of its segment, or of the free parts
  std::int32_t before = -1;
  std::int32_t rows = 0;
  std::array<std::uint64_t, kRows> words{};
};

/// Where a segment begins or ends: a node of the graph, at its exact place, or a spot off it.
struct Place {
  Spot spot;
  Node node = -1;
  friend bool operator==(const Place&, const Place&) = default;
};

struct Segment {
  Place from;
  Place to;
  Metres length{};
  std::int32_t first_part = -1;
  std::int32_t last_part = -1;
  std::int32_t parts = 0;
  std::int32_t next_free = -1;
};

class SegmentPool {
 public:
  static constexpr int kSegments = 4 * limits::kNodes;
  static constexpr int kParts = 4 * limits::kNodes;

  /// Another mission. `map` and `cells` outlive this. False when a sight disc is too many cells wide for a part.
  [[nodiscard]] bool open(const SegmentedMap& map, const Cells& cells, const Graph& graph, const Bodies& bodies,
                          double clearance_m) noexcept;

  /// A segment for `agent`, -1 when it is not proved free or there is no room. An edge of the graph is proved; anything
  /// else must keep the nodes' clearance all along. Adds the work done to `work`.
  [[nodiscard]] std::int32_t make(int agent, const Place& from, const Place& to, int& work) noexcept;
  void release(std::int32_t segment) noexcept;

  [[nodiscard]] const Segment& operator[](std::int32_t s) const noexcept { return segments_[index(s)]; }
  [[nodiscard]] const Part& part(std::int32_t p) const noexcept { return parts_[index(p)]; }
  /// True when both may use the same segments.
  [[nodiscard]] bool alike(int a, int b) const noexcept { return bodies_[index(a)].like(bodies_[index(b)]); }
  [[nodiscard]] Place place_of(Node n) const noexcept { return {spot_at(graph_->position(n)), n}; }
  [[nodiscard]] Point point_at(const Place& place) const noexcept {
    return place.node >= 0 ? graph_->position(place.node) : point_of(place.spot);
  }

 private:
  struct Disc {  // of one sight radius, in ticks
    std::int32_t radius = 0;
    std::array<std::int16_t, 4096> half{};  // half-width by distance from the middle row
  };

  [[nodiscard]] bool free(int agent, const Place& from, const Place& to, int& work) const noexcept;
  void sweep(int agent, Spot p, Spot q, Part& part, int& work) noexcept;
  void hide(int agent, Spot p, Spot q, Part& part, int& work) noexcept;
  [[nodiscard]] int disc_of(int agent) const noexcept { return disc_of_agent_[index(agent)]; }

  SegmentedMap map_;
  const Cells* cells_ = nullptr;
  const Graph* graph_ = nullptr;
  Bodies bodies_;
  double clearance_m_ = 0.0;
  std::int64_t cell_q_ = 1;  // side of a cell, in 1/256 tick
  std::int64_t inverse_q_ = 1;  // 2^40 / cell_q_
  std::int32_t part_ticks_ = 1;  // longest part
  std::array<Disc, limits::kAgents> discs_{};
  std::array<int, limits::kAgents> disc_of_agent_{};
  std::array<ClearanceMap, kAgentKinds> clear_{};

  std::array<Segment, kSegments> segments_{};
  std::array<Part, kParts> parts_{};
  std::int32_t free_segment_ = -1;
  std::int32_t free_part_ = -1;
  std::int32_t free_parts_ = 0;
};

}  // namespace ivo::planner
