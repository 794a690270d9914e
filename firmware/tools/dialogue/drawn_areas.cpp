#include "firmware/tools/dialogue/drawn_areas.hpp"

#include <cmath>

namespace ivo::firmware {

using console::AreaCommand;
using console::AreaPurpose;

Polygon border_of(const console::DrawnArea& area) {
  Polygon border;
  for (std::size_t i = 0; i < area.corners; ++i) {
    border.push_back({area.corner[i].x_m, area.corner[i].y_m});
  }
  return border;
}

double area_m2(const Polygon& border) {
  double twice = 0.0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Point a = border[i];
    const Point b = border[(i + 1) % border.size()];
    twice += a.x_m * b.y_m - b.x_m * a.y_m;
  }
  return std::abs(twice) / 2;
}

std::vector<AgentSpec> agents_with(const std::vector<AgentSpec>& agents, const console::AreaBoard& board,
                                   bool preferred, PreferredSlots& slots) {
  std::vector<AgentSpec> drawn = agents;
  for (std::size_t m = 0; m < drawn.size(); ++m) {
    AgentSpec& agent = drawn[m];
    agent.preferred.clear();
    agent.restricted.clear();
    agent.sub_prior.reset();
    slots[m].clear();
    for (std::size_t slot = 0; slot < board.slots().size(); ++slot) {
      const auto& area = board.slots()[slot];
      if (!area || (area->agent != m && area->agent != AreaCommand::kEverybody)) {
        continue;
      }
      if (area->purpose == AreaPurpose::kNoGo) {
        agent.restricted.push_back(border_of(*area));
      } else if (preferred) {
        agent.preferred.push_back(border_of(*area));
        slots[m].push_back(static_cast<std::uint8_t>(slot));
      }
    }
  }
  return drawn;
}

bool draw(const Mission& mission, console::ConsoleDesk& desk) {
  std::uint8_t slot = 0;
  bool all = true;
  const auto put = [&](const Polygon& border, AreaPurpose purpose, std::size_t agent) {
    AreaCommand area;
    area.slot = slot;
    area.purpose = purpose;
    area.agent = static_cast<std::uint8_t>(agent);
    area.corners = static_cast<std::uint8_t>(border.size());
    for (std::size_t i = 0; i < border.size(); ++i) {
      area.corner[i] = {border[i].x_m, border[i].y_m};
    }
    if (slot < console::kAreaSlots && desk.put(area) == console::Verdict::kAccepted) {
      ++slot;
    } else {
      all = false;
    }
  };
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    for (const Polygon& border : mission.agents[m].preferred) {
      put(border, AreaPurpose::kPreferred, m);
    }
    for (const Polygon& border : mission.agents[m].restricted) {
      put(border, AreaPurpose::kNoGo, m);
    }
  }
  return all;
}

}  // namespace ivo::firmware
