// A simulated drive, the SDO server among its parts, with any frames at any time.
#include "drivers/sim/sim_drive.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo;
using fuzz::require;

/// CiA 301, 7.3.5: no PDO and no EMCY may have them, whatever was written.
bool restricted(int id) {
  return id <= 0x07F || (id >= 0x101 && id <= 0x180) || (id >= 0x581 && id <= 0x5FF) || (id >= 0x601 && id <= 0x67F) ||
         (id >= 0x6E0 && id <= 0x6FF) || id >= 0x701;
}

void check(const drivers::SimDrive::Outbox& out, std::size_t before, std::uint8_t node) {
  require(out.size() - before <= drivers::SimDrive::kFramesPerCall, "one call sends no more than it says");
  for (std::size_t i = before; i < out.size(); ++i) {
    require(out[i].size <= 8, "what a drive sends is a frame");
    // A master may give a PDO another COB-ID.
    require((out[i].id & 0x7F) == node || !restricted(out[i].id), "a drive speaks in its own name");
    require(out[i].id != 0x580 + node || out[i].size == 8, "an SDO has eight bytes");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  const DriveParameters parameters = Robot{}.drives[1];
  const std::uint8_t node = parameters.node_id;
  drivers::SimDrive drive(parameters);
  drivers::SimDrive::Outbox out;
  drive.open(out);
  while (!input.empty()) {
    out.clear();
    static constexpr std::array<std::uint16_t, 6> kFunctions = {0x600, 0x600, 0x200, 0x080, 0x000, 0x700};
    const unsigned kind = input.up_to(7);
    if (kind < kFunctions.size()) {
      const std::uint16_t function = kFunctions[kind];
      std::uint16_t id = function;
      if (function == 0x700) {
        id = 0x77F;
      } else if (function > 0x080) {
        id = static_cast<std::uint16_t>(function + node);
      }
      hal::CanFrame frame = input.frame(id);
      if (function == 0x600 && input.up_to(3) != 0) {
        frame.size = 8;
      }
      drive.on_frame(frame, out);
    } else if (kind == 6) {
      drive.on_frame(input.frame(input.take<std::uint16_t>() & 0x7FF), out);
    } else {
      drive.advance_to(drive.now() + Duration(input.take<std::uint32_t>() % 50'000'000), out);
    }
    check(out, 0, node);
  }
  return 0;
}
