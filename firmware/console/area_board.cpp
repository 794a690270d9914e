#include "firmware/console/area_board.hpp"

#include <algorithm>
#include <span>

#include "config/base/static_vector.hpp"
#include "config/simple_polygon.hpp"

namespace ivo::firmware::console {
namespace {

using Border = StaticVector<Point, kAreaCorners>;

Border border_of(const AreaCommand& area) {
  Border border;
  for (std::size_t i = 0; i < area.corners; ++i) {
    (void)border.push_back({area.corner[i].x_m, area.corner[i].y_m});
  }
  return border;
}

bool concerns(std::uint8_t agent, int one) { return agent == one || agent == AreaCommand::kEverybody; }

}  // namespace

Verdict AreaBoard::put(const AreaCommand& area) {
  if (area.agent != AreaCommand::kEverybody && area.agent >= rules_.agents) {
    return Verdict::kOutOfRange;
  }
  const Border border = border_of(area);
  if (judge_polygon(border.span()).fault != PolygonFault::kNone) {
    return Verdict::kNotAnArea;
  }
  const auto [west, east] = std::ranges::minmax(border, {}, &Point::x_m);
  const auto [south, north] = std::ranges::minmax(border, {}, &Point::y_m);
  const bool on_the_map = east.x_m > 0 && west.x_m < rules_.width_m && north.y_m > 0 && south.y_m < rules_.height_m;
  if (!on_the_map || !has_room_for(area)) {
    return Verdict::kOutOfRange;
  }
  slots_[area.slot] = DrawnArea{area.purpose, area.agent, area.corners, area.corner};
  ++revision_;
  return Verdict::kAccepted;
}

void AreaBoard::remove(std::uint32_t slot) {
  if (slots_[slot]) {
    slots_[slot].reset();
    ++revision_;
  }
}

bool AreaBoard::has_room_for(const AreaCommand& area) const {
  for (int agent = 0; agent < rules_.agents; ++agent) {
    int taken = 0;
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      const std::optional<DrawnArea>& drawn = slots_[slot];
      taken += slot != area.slot && drawn && drawn->purpose == area.purpose && concerns(drawn->agent, agent) ? 1 : 0;
    }
    if (concerns(area.agent, agent) && taken >= limits::kAreas) {
      return false;
    }
  }
  return true;
}

}  // namespace ivo::firmware::console
