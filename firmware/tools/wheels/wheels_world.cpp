#include "firmware/tools/wheels/wheels_world.hpp"

#include <utility>

#include "drivers/canopen/bus_ids.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/robot_file.hpp"
#include "hal/linux/gpio_inputs.hpp"
#include "hal/linux/monotonic_clock.hpp"
#include "hal/linux/paced_clock.hpp"
#include "hal/linux/socketcan_bus.hpp"
#include "hal/sim/digital_inputs.hpp"
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
  [[nodiscard]] hal::DigitalInputs* inputs() noexcept override { return &released_; }
  void after_cycle() noexcept override { drives_.update(paced_.now()); }
  [[nodiscard]] std::string description() const override {
    return "virtual, with four simulated drives in this process";
  }

 private:
  Robot base_;
  hal::VirtualBus bus_;
  hal::PacedClock paced_;
  drivers::SimDrives drives_;
  hal::SimDigitalInputs released_;
};

class SocketWorld final : public World {
 public:
  SocketWorld(const Robot& robot, const std::string& source, std::string interface, hal::SocketCanBus bus)
      : World(robot, source), interface_(std::move(interface)), bus_(std::move(bus)) {}

  hal::CanBus& bus() noexcept override { return bus_; }
  hal::Clock& clock() noexcept override { return clock_; }
  [[nodiscard]] hal::DigitalInputs* inputs() noexcept override { return inputs_.get(); }
  Result<void> open_inputs() {
    if (robot().inputs.chip.empty()) {
      return {};
    }
    Result<std::unique_ptr<hal::GpioInputs>> inputs = hal::GpioInputs::open(robot().inputs, clock_);
    if (!inputs) {
      return inputs.error();
    }
    inputs_ = std::move(inputs).value();
    return {};
  }
  void after_cycle() noexcept override {}
  [[nodiscard]] std::string description() const override {
    return interface_ + ", for " + shortest(robot().bit_rate_bps / 1000.0) + " kbit/s";
  }

 private:
  std::string interface_;
  hal::SocketCanBus bus_;
  hal::MonotonicClock clock_;
  std::unique_ptr<hal::GpioInputs> inputs_;  // after the clock that it reads
};

Result<Robot> robot_from(const std::string& path) { return path.empty() ? Result<Robot>(Robot{}) : read_robot(path); }

}  // namespace

Result<std::unique_ptr<World>> World::open(const Options& options, Purpose purpose) {
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
  const drivers::BusIds ids = purpose == Purpose::kTurn ? drivers::bus_ids(robot.value()) : drivers::BusIds();
  Result<hal::SocketCanBus> bus =
      hal::SocketCanBus::open(options.can, {.ids = ids.span(), .bit_rate_bps = robot.value().bit_rate_bps});
  if (!bus) {
    return bus.error();
  }
  auto world = std::make_unique<SocketWorld>(robot.value(), source, options.can, std::move(bus).value());
  if (purpose == Purpose::kTurn) {
    if (const Result<void> opened = world->open_inputs(); !opened) {
      return opened.error();
    }
  }
  return std::unique_ptr<World>(std::move(world));
}

}  // namespace ivo::firmware::wheels
