#include "planner/search/lanes.hpp"

#include <algorithm>

namespace ivo::planner {
namespace {

// Coordinates across the lanes and along them.
struct Frame {
  bool along_x = false;
  [[nodiscard]] std::int32_t across(Spot s) const noexcept { return along_x ? s.y : s.x; }
  [[nodiscard]] std::int32_t along(Spot s) const noexcept { return along_x ? s.x : s.y; }
  [[nodiscard]] Spot spot(std::int32_t across, std::int32_t along) const noexcept {
    return along_x ? Spot{along, across} : Spot{across, along};
  }
};

struct Strip {
  std::int32_t low = 0;
  std::int32_t high = 0;
};

// Strips lie in the order in which the agents stand across them.
Strip strip_of(const LaneTeam& team, int agent, const Frame& frame, std::int32_t extent) noexcept {
  std::int64_t before = 0;
  std::int64_t all = 0;
  const std::int32_t mine = frame.across(team.starts[index(agent)]);
  for (int m = 0; m < team.agents; ++m) {
    const std::int32_t other = frame.across(team.starts[index(m)]);
    all += team.sweep[index(m)];
    if (other < mine || (other == mine && m < agent)) {
      before += team.sweep[index(m)];
    }
  }
  return {static_cast<std::int32_t>(extent * before / all),
          static_cast<std::int32_t>(extent * (before + team.sweep[index(agent)]) / all)};
}

}  // namespace

void fill_lanes(const LaneTeam& team, int agent, int number, Lanes& lanes) noexcept {
  constexpr std::array<std::int32_t, 3> kTurns = {10, 8, 6};  // tenths of a sight radius
  lanes.clear();
  const Frame frame{number % 2 != 0};
  const std::int32_t extent = frame.along_x ? team.height : team.width;
  const std::int32_t length = frame.along_x ? team.width : team.height;
  const std::int32_t sight = team.sight[index(agent)];
  const Strip strip = strip_of(team, agent, frame, extent);
  const std::int32_t count = std::max(1, (strip.high - strip.low + 2 * sight - 1) / (2 * sight));
  if (index(2 * count) > lanes.capacity()) {
    return;
  }
  const Spot start = team.starts[index(agent)];
  const std::int32_t turn = std::min(std::max(team.border, sight * kTurns[index(number / 2)] / 10), length / 2);
  const bool from_low = frame.across(start) - strip.low <= strip.high - frame.across(start);
  bool up = frame.along(start) <= length / 2;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t k = from_low ? i : count - 1 - i;
    const auto lane =
        static_cast<std::int32_t>(strip.low + std::int64_t{strip.high - strip.low} * (2 * k + 1) / (2 * count));
    const std::int32_t across = std::clamp(lane, team.border, std::max(team.border, extent - team.border));
    (void)lanes.push_back(frame.spot(across, up ? turn : length - turn));
    (void)lanes.push_back(frame.spot(across, up ? length - turn : turn));
    up = !up;
  }
}

}  // namespace ivo::planner
