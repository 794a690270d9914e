// Masses of a belief as tests calculate with them.
#pragma once

#include <algorithm>
#include <vector>

#include "planner/numeric/index.hpp"
#include "planner/numeric/scalar.hpp"

namespace ivo::test {

/// The first `count` masses.
template <class Masses>
std::vector<double> as_doubles(const Masses& masses, int count) {
  std::vector<double> values(planner::index(count));
  std::transform(masses.begin(), masses.begin() + count, values.begin(),
                 [](planner::Mass mass) { return planner::to_double(mass); });
  return values;
}

}  // namespace ivo::test
