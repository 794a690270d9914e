// Areas as tests draw them.
#pragma once

#include "planner/world/polygon.hpp"

namespace ivo::test {

inline planner::Area rectangle(double x0_m, double y0_m, double x1_m, double y1_m) {
  planner::Area area;
  area.resize(4);
  area[0] = {x0_m, y0_m};
  area[1] = {x1_m, y0_m};
  area[2] = {x1_m, y1_m};
  area[3] = {x0_m, y1_m};
  return area;
}

}  // namespace ivo::test
