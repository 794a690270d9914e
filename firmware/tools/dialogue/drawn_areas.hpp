// Areas as people draw them at the console, as a mission has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "config/limits.hpp"
#include "config/mission.hpp"
#include "firmware/console/area_board.hpp"
#include "firmware/console/console_desk.hpp"

namespace ivo::firmware {

/// Of each agent, the slots that its preferred areas came from.
using PreferredSlots = std::array<std::vector<std::uint8_t>, limits::kAgents>;

/// The mission's agents with the drawn areas in place of their own; preferred ones only where they are asked for.
[[nodiscard]] std::vector<AgentSpec> agents_with(const std::vector<AgentSpec>& agents, const console::AreaBoard& board,
                                                 bool preferred, PreferredSlots& slots);

/// The mission's own areas, drawn. False when not all have room there.
[[nodiscard]] bool draw(const Mission& mission, console::ConsoleDesk& desk);

[[nodiscard]] Polygon border_of(const console::DrawnArea& area);
/// m^2, of a simple polygon.
[[nodiscard]] double area_m2(const Polygon& border);

}  // namespace ivo::firmware
