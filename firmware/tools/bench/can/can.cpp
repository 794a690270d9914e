// `ivo bench can`: what the wheel bus costs, carries and does when something goes wrong, on a kernel's own bus.
#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/can/bus_figures.hpp"
#include "firmware/tools/bench/can/fault_table.hpp"
#include "firmware/tools/bench/guest.hpp"

namespace ivo::firmware::bench {

void can(const Options& options, Sheet& sheet) {
  if (!owns_network()) {
    Result<std::vector<Record>> records = records_from_guest(Guest::kVcan, "can", options);
    records ? sheet.take(std::move(records).value()) : sheet.skip("all", records.error().message);
    return;
  }
  cycle_cost(options, sheet);
  frames_a_second(options, sheet);
  bus_load(options, sheet);
  fault_table(sheet);
}

}  // namespace ivo::firmware::bench
