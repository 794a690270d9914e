#include "firmware/tools/wheels/wheels_world.hpp"

#include <utility>

#include "drivers/sim/sim_drives.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/robot_file.hpp"
#include "hal/linux/monotonic_clock.hpp"
#include "hal/linux/paced_clock.hpp"
#include "hal/linux/socketcan_bus.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::firmware::wheels {
namespace {

class VirtualWorld final : public World {
 public:
  VirtualWorld(const Robot& robot, const std::string& source, const Robot& base)
      : World(robot, source),
        base_(base),
        paced_(1.0, robot.cycle),
        drives_(bus_.port(1), base_, drivers::SimDrives::TimeFrom::kClock) {
    drives_.open();
  }

  hal::CanBus& bus() noexcept override { return bus_.port(0); }
  hal::Clock& clock() noexcept override { return paced_; }
  void after_cycle() noexcept override { drives_.update(paced_.now()); }
  [[nodiscard]] std::string description() const override {
    return "virtual, with four simulated drives in this process";
  }

 private:
  Robot base_;
  hal::VirtualBus bus_;
  hal::PacedClock paced_;
  drivers::SimDrives drives_;
};

class SocketWorld final : public World {
 public:
  SocketWorld(const Robot& robot, const std::string& source, std::string interface, hal::SocketCanBus bus)
      : World(robot, source), interface_(std::move(interface)), bus_(std::move(bus)) {}

  hal::CanBus& bus() noexcept override { return bus_; }
  hal::Clock& clock() noexcept override { return clock_; }
  void after_cycle() noexcept override {}
  [[nodiscard]] std::string description() const override {
    return interface_ + ", which should run at " + shortest(robot().bit_rate_bps / 1000.0) + " kbit/s";
  }

 private:
  std::string interface_;
  hal::SocketCanBus bus_;
  hal::MonotonicClock clock_;
};

Result<Robot> robot_from(const std::string& path) { return path.empty() ? Result<Robot>(Robot{}) : read_robot(path); }

}  // namespace

Result<std::unique_ptr<World>> World::open(const Options& options) {
  if (options.can.empty() == !options.simulated) {
    return Error{options.simulated ? "--sim together with --can " + options.can + "; expected one of them"
                                   : "no bus: expected --can INTERFACE, as can0, or --sim for four simulated drives"};
  }
  if (!options.simulated && !options.simulated_robot.empty()) {
    return Error{"--sim-robot: the drives on " + options.can +
                 " are no simulated ones; expected it together with --sim"};
  }
  const Result<Robot> robot = robot_from(options.robot);
  if (!robot) {
    return robot.error();
  }
  const std::string source = options.robot.empty() ? "built in, as config/robots/ivo.toml" : options.robot;
  if (options.simulated) {
    const Result<Robot> base = options.simulated_robot.empty() ? robot : read_robot(options.simulated_robot);
    if (!base) {
      return base.error();
    }
    return std::unique_ptr<World>(std::make_unique<VirtualWorld>(robot.value(), source, base.value()));
  }
  Result<hal::SocketCanBus> bus = hal::SocketCanBus::open(options.can);
  if (!bus) {
    return bus.error();
  }
  return std::unique_ptr<World>(
      std::make_unique<SocketWorld>(robot.value(), source, options.can, std::move(bus).value()));
}

}  // namespace ivo::firmware::wheels
