// A plan while it is improved: for each agent the segments it follows, one after the other.
#pragma once

#include <array>
#include <cstdint>

#include "config/base/static_vector.hpp"
#include "planner/search/segment_pool.hpp"

namespace ivo::planner {

/// A segment of the pool and the direction in which it is gone.
struct Leg {
  std::int32_t segment = -1;
  bool back = false;
  [[nodiscard]] Leg turned() const noexcept { return {segment, !back}; }
};

/// One fewer than the waypoints that they join.
using Legs = StaticVector<Leg, limits::kWaypoints - 1>;

template <std::size_t N>
[[nodiscard]] int size_of(const StaticVector<Leg, N>& legs) noexcept {
  return static_cast<int>(legs.size());
}

[[nodiscard]] inline Place end_of(const Leg& leg, const SegmentPool& pool) noexcept {
  return leg.back ? pool[leg.segment].from : pool[leg.segment].to;
}

struct Route {
  std::array<Legs, limits::kAgents> legs;

  void assign(const Route& other, int agents) noexcept {
    for (int m = 0; m < agents; ++m) {
      legs[index(m)].assign(other.legs[index(m)]);
    }
  }
};

}  // namespace ivo::planner
