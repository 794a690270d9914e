// The TOML reader and the robot on top of it, on any bytes. What is accepted keeps the promises of config/robot.hpp.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <set>
#include <string>

#include "drivers/canopen/bus_load.hpp"
#include "firmware/files/robot_file.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo;
using fuzz::require;

/// A file in memory, by a path.
class MemoryFile {
 public:
  MemoryFile() : fd_(memfd_create("robot", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(fd_)) {
    require(fd_ >= 0, "there is memory for a file");
  }
  const std::string& put(std::span<const std::uint8_t> bytes) const {
    require(ftruncate(fd_, 0) == 0, "a file in memory can be emptied");
    require(pwrite(fd_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()), "and written");
    return path_;
  }

 private:
  int fd_;
  std::string path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile file;
  const Result<Robot> read = firmware::read_robot(file.put({data, size}));
  if (!read.ok()) {
    const std::string& message = read.error().message;
    require(!message.empty() && message.find('\n') == std::string::npos, "a refusal is one line");
    return 0;
  }
  const Robot& robot = read.value();
  std::set<int> nodes{robot.master_node_id};
  for (const DriveParameters& drive : robot.drives) {
    require(drive.node_id >= 1 && drive.node_id <= 127, "node-ids are in range");
    require(nodes.insert(drive.node_id).second, "node-ids are not shared");
    require(drive.sign == 1 || drive.sign == -1, "a sign is a direction");
    const double units = robot.base.max_wheel_radps * drive.gear_ratio * drive.velocity_per_radps;
    require(std::isfinite(units) && units <= 2147483647.0, "full speed fits into a target");
  }
  require(drivers::fits(robot), "the bus carries what a cycle sends");
  return 0;
}
