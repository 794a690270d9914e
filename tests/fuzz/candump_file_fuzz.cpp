// The reader of records, on any bytes.
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "drivers/canopen/bus_load.hpp"
#include "firmware/files/candump_file.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo;
using fuzz::require;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int fd = memfd_create("log", MFD_CLOEXEC);
  static const std::string path = "/proc/self/fd/" + std::to_string(fd);
  require(ftruncate(fd, 0) == 0 && pwrite(fd, data, size, 0) == static_cast<ssize_t>(size), "memory holds a file");

  drivers::LoadMeter meter(1'000'000);
  std::uint64_t frames = 0;
  const auto read = firmware::read_candump(path, [&](Instant at, const hal::CanFrame& frame) {
    require(frame.id <= 0x7FF && frame.size <= 8, "what is read is a frame");
    meter.add(at, frame);
    ++frames;
  });
  require(!read.ok() || read.value().frames == frames, "frames are counted as they are given");
  require(read.ok() || read.error().message.find('\n') == std::string::npos, "a refusal is one line");
  require(meter.figures().mean >= 0.0, "a load is not negative");
  return 0;
}
