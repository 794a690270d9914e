// The fault table as people read it.
#pragma once

#include <span>
#include <string>

#include "firmware/tools/bench/bench.hpp"

namespace ivo::firmware::bench {

/// Every record of the can bench: the others as table_of has them, then each fault with what provokes it and its
/// figures, below it what the operator reads, and below that what did not hold. Ends with a line that sums it up.
[[nodiscard]] std::string table_with_faults(std::span<const Record> records);

}  // namespace ivo::firmware::bench
