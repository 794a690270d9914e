// `ivo bench can`: what the wheel bus costs, carries and does when something goes wrong, on a kernel's own bus.
#include <cstdlib>

#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/can/fault_table.hpp"

namespace ivo::firmware::bench {

void can(const Options& /*options*/, Sheet& sheet) { fault_table(sheet); }

}  // namespace ivo::firmware::bench
