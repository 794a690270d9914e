// Straight moves between any two places, with what is seen along each: the stuff that improved plans are made of. A
// segment keeps its sight as swaths of one word a row, each over a short part of the way; they are made from a
// half-width a row, so that a segment costs a microsecond where nothing hides, and rays only elsewhere. Good for
// judging a change, not for the score that a plan is shown with (path_score.hpp).
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/lattice.hpp"
#include "planner/search/world.hpp"
#include "planner/world/clearance_map.hpp"

namespace ivo::planner {

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

  explicit SegmentPool(const World& world) noexcept : world_(world) {}

  /// Another mission. False when a sight disc is too many cells wide for a part, cells are smaller than the lattice's,
  /// or the map is longer than 500 km. Cost: the pixels and the cells.
  [[nodiscard]] bool open() noexcept;

  /// Begins a segment for `agent`; -1 when it is not proved free or there is no room. An edge of the graph is proved;
  /// anything else must keep the nodes' clearance all along. Adds the work done to `work`.
  [[nodiscard]] std::int32_t begin(int agent, const Place& from, const Place& to, int& work) noexcept;
  /// Goes on with the segment begun last until `work` has come to `enough`; true when it is made.
  [[nodiscard]] bool make_rows(int& work, int enough) noexcept;
  /// Both at once.
  [[nodiscard]] std::int32_t make(int agent, const Place& from, const Place& to, int& work) noexcept;
  void release(std::int32_t segment) noexcept;

  [[nodiscard]] const Segment& operator[](std::int32_t s) const noexcept { return segments_[index(s)]; }
  [[nodiscard]] const Part& part(std::int32_t p) const noexcept { return parts_[index(p)]; }
  /// True when both may use the same segments.
  [[nodiscard]] bool alike(int a, int b) const noexcept {
    return world_.bodies[index(a)].like(world_.bodies[index(b)]);
  }
  [[nodiscard]] Place place_of(Node n) const noexcept { return {spot_at(world_.graph.position(n)), n}; }
  [[nodiscard]] Point point_at(const Place& place) const noexcept {
    return place.node >= 0 ? world_.graph.position(place.node) : point_of(place.spot);
  }

 private:
  struct Disc {  // of one sight radius, in ticks
    static constexpr std::size_t kMost = 4096;
    std::int32_t radius = 0;
    std::array<std::int16_t, kMost> half{};  // half-width by distance from the middle row
  };

  struct Sweep {  // the part under way
    Spot p;
    Spot q;
    Spot side;  // from a centre to where a tangent touches
    std::int64_t slope = 0;
    bool hides = false;  // something near can hide something
  };

  [[nodiscard]] bool proved(int agent, const Place& from, const Place& to, int& work) const noexcept;
  void begin_part(Part& part, int& work) noexcept;
  [[nodiscard]] std::uint64_t sweep_row(const Part& part, std::int32_t i, int& work) noexcept;
  [[nodiscard]] std::uint64_t seen_of(std::uint64_t word, const Part& part, std::int32_t i, int& work) const noexcept;
  [[nodiscard]] int disc_of(int agent) const noexcept { return disc_of_agent_[index(agent)]; }

  const World& world_;
  std::int64_t cell_q_ = 1;      // side of a cell, in 1/256 tick
  std::int64_t inverse_q_ = 1;   // 2^40 / cell_q_
  std::int32_t part_ticks_ = 1;  // longest part
  std::array<Disc, limits::kAgents> discs_{};
  std::array<int, limits::kAgents> disc_of_agent_{};
  std::array<ClearanceMap, kAgentKinds> clear_{};

  std::array<Segment, kSegments> segments_{};
  std::array<Part, kParts> parts_{};
  // The segment under way.
  std::int32_t making_ = -1;
  std::int32_t next_part_ = -1;
  std::int32_t parts_made_ = 0;
  std::int32_t row_ = -1;  // of the part under way; -1: it is yet to begin
  Sweep sweep_;
  int agent_ = 0;

  std::int32_t free_segment_ = -1;
  std::int32_t free_part_ = -1;
  std::int32_t free_parts_ = 0;
};

}  // namespace ivo::planner
