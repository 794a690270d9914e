#include "firmware/tools/run_world.hpp"

#include <utility>

#include "config/rates.hpp"
#include "drivers/canopen/bus_ids.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/sim_script_file.hpp"
#include "hal/linux/gpio_inputs.hpp"
#include "hal/linux/interface_watch.hpp"
#include "hal/linux/lock_step.hpp"
#include "hal/linux/monotonic_clock.hpp"
#include "hal/linux/paced_clock.hpp"
#include "hal/linux/socketcan_bus.hpp"
#include "hal/sim/manual_clock.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::firmware {
namespace {

class VirtualWorld final : public RunWorld {
 public:
  VirtualWorld(const RunOptions& options, const Robot& robot, const drivers::SimDrives::Scripts& scripts)
      : paced_(options.speed, from_seconds(seconds(robot.cycle) * options.speed)),
        max_speed_(options.max_speed),
        speed_(options.speed),
        drives_(bus_.port(1), robot, drivers::SimDrives::TimeFrom::kClock, scripts) {
    drives_.open();
  }

  hal::CanBus& bus() noexcept override { return bus_.port(0); }
  hal::Clock& clock() noexcept override { return max_speed_ ? static_cast<hal::Clock&>(manual_) : paced_; }
  hal::Clock& stopwatch() noexcept override { return host_; }
  [[nodiscard]] Time time() const noexcept override { return Time::kSimulated; }
  void after_cycle(const ControlLoop& /*loop*/) noexcept override { drives_.update(clock().now()); }
  [[nodiscard]] std::uint64_t lapses() const noexcept override { return paced_.lapses(); }
  [[nodiscard]] bool own_time() const noexcept override { return max_speed_; }
  [[nodiscard]] std::string description() const override {
    return "virtual bus, four simulated drives in this process, " +
           (max_speed_ ? std::string("as fast as it goes") : shortest(speed_) + " x real time");
  }

 private:
  hal::VirtualBus bus_;
  hal::MonotonicClock host_;
  hal::ManualClock manual_;
  hal::PacedClock paced_;
  bool max_speed_;
  double speed_;
  drivers::SimDrives drives_;
};

class SocketWorld final : public RunWorld {
 public:
  SocketWorld(const RunOptions& options, hal::SocketCanBus bus)
      : interface_(options.can), bus_(std::move(bus)), watch_(bus_) {}

  Result<void> open_inputs(const InputParameters& parameters) {
    if (parameters.chip.empty()) {
      return {};
    }
    Result<std::unique_ptr<hal::GpioInputs>> inputs = hal::GpioInputs::open(parameters, clock_);
    if (!inputs) {
      return inputs.error();
    }
    inputs_ = std::move(inputs).value();
    return {};
  }

  hal::CanBus& bus() noexcept override { return bus_; }
  hal::Clock& clock() noexcept override { return clock_; }
  hal::Clock& stopwatch() noexcept override { return clock_; }
  [[nodiscard]] Time time() const noexcept override {
    const hal::InterfaceFacts::Kind kind = bus_.facts().kind;
    const bool simulated = kind == hal::InterfaceFacts::Kind::kVcan || kind == hal::InterfaceFacts::Kind::kVxcan;
    return simulated ? Time::kRealOnSimulatedBus : Time::kReal;
  }
  [[nodiscard]] hal::DigitalInputs* inputs() noexcept override { return inputs_.get(); }
  void after_cycle(const ControlLoop& /*loop*/) noexcept override {}
  [[nodiscard]] bool own_time() const noexcept override { return false; }
  [[nodiscard]] std::string description() const override {
    const std::string advice = hal::advice(bus_.facts());
    return interface_ + ", real time" + (advice.empty() ? "" : "; " + advice);
  }

 private:
  std::string interface_;
  hal::SocketCanBus bus_;
  hal::InterfaceWatch watch_;
  hal::MonotonicClock clock_;
  std::unique_ptr<hal::GpioInputs> inputs_;  // after the clock that it reads
};

class LockStepWorld final : public RunWorld {
 public:
  LockStepWorld(const RunOptions& options, hal::SocketCanBus bus, const Robot& robot)
      : interface_(options.can), bus_(std::move(bus)), lock_step_(bus_, answers(robot)) {}

  hal::CanBus& bus() noexcept override { return lock_step_; }
  hal::Clock& clock() noexcept override { return lock_step_; }
  hal::Clock& stopwatch() noexcept override { return host_; }
  [[nodiscard]] Time time() const noexcept override { return Time::kSimulated; }
  void after_cycle(const ControlLoop& loop) noexcept override {
    lock_step_.expect_answers(loop.answers_awaited());
    for (std::size_t i = 0; i < kWheels; ++i) {
      lock_step_.answer_with(i, loop.feedback_id(static_cast<Wheel>(i)));
    }
  }
  [[nodiscard]] bool stalled() const noexcept override { return lock_step_.stalled(); }
  [[nodiscard]] bool own_time() const noexcept override { return true; }
  [[nodiscard]] std::string description() const override { return interface_ + ", in lock step with the drives"; }

 private:
  static hal::LockStep::Options answers(const Robot& robot) {
    hal::LockStep::Options options;
    for (const DriveParameters& drive : robot.drives) {
      (void)options.answer_ids.push_back(drivers::cob_id::tpdo1(drive.node_id));
    }
    return options;
  }

  std::string interface_;
  hal::SocketCanBus bus_;
  hal::MonotonicClock host_;
  hal::LockStep lock_step_;
};

}  // namespace

Result<std::unique_ptr<RunWorld>> RunWorld::open(const RunOptions& options, const Robot& robot) {
  if (options.can.empty()) {
    if (options.lock_step) {
      return Error{
          "--clock sync: there is nobody to keep step with on the virtual bus; expected it together with --can "
          "INTERFACE"};
    }
    const Result<drivers::SimDrives::Scripts> scripts =
        options.script.empty() ? Result<drivers::SimDrives::Scripts>(drivers::SimDrives::Scripts())
                               : read_sim_script(options.script);
    if (!scripts) {
      return scripts.error();
    }
    return std::unique_ptr<RunWorld>(std::make_unique<VirtualWorld>(options, robot, scripts.value()));
  }
  if (!options.script.empty()) {
    return Error{"--script: the drives on " + options.can +
                 " are not ours; expected it without --can, or of ivo-drives"};
  }
  if (options.max_speed || options.speed != 1.0) {
    return Error{"--speed: drives on " + options.can + " have their own time; expected no --speed together with --can"};
  }
  // A real bus does not wait for us, and real drives would turn while our time stands still.
  if (options.lock_step && !options.can.starts_with("vcan") && !options.can.starts_with("vxcan")) {
    return Error{"--clock sync: " + options.can + " may be a real interface; expected a virtual one, as vcan0"};
  }
  const drivers::BusIds ids = drivers::bus_ids(robot);
  Result<hal::SocketCanBus> bus =
      hal::SocketCanBus::open(options.can, {.ids = ids.span(), .bit_rate_bps = robot.bit_rate_bps});
  if (!bus) {
    return bus.error();
  }
  if (options.lock_step) {
    return std::unique_ptr<RunWorld>(std::make_unique<LockStepWorld>(options, std::move(bus).value(), robot));
  }
  auto world = std::make_unique<SocketWorld>(options, std::move(bus).value());
  if (const Result<void> opened = world->open_inputs(robot.inputs); !opened) {
    return opened.error();
  }
  return std::unique_ptr<RunWorld>(std::move(world));
}

}  // namespace ivo::firmware
