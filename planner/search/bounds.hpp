// Lower bounds on the expected time of any plan of a mission (model.md, "Bounds").
#pragma once

#include <algorithm>

namespace ivo::planner {

struct LowerBound {
  double nominal_s = 0.0;  ///< with R
  double strict_s = 0.0;   ///< with R + res/sqrt(2): holds on cells too
};

struct Bounds {
  LowerBound area;   ///< LB-A
  LowerBound reach;  ///< LB-B
  [[nodiscard]] double bound_s() const noexcept { return std::max(area.nominal_s, reach.nominal_s); }
  [[nodiscard]] double bound_strict_s() const noexcept { return std::max(area.strict_s, reach.strict_s); }
};

}  // namespace ivo::planner
