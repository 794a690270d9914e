// All rows of the fault table, tried one after the other.
#pragma once

#include "firmware/tools/bench/bench.hpp"

namespace ivo::firmware::bench {

/// A case a row, "NUMBER NAME". Clock: simulated.
void fault_table(Sheet& sheet);

}  // namespace ivo::firmware::bench
