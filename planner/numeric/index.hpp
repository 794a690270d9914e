// Nodes, edges and cells are signed, so that "none" is -1; arrays are not.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ivo::planner {

[[nodiscard]] constexpr std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace ivo::planner
