// Bus, clock and robot of one `ivo wheels`.
#pragma once

#include <memory>
#include <string>

#include "config/base/result.hpp"
#include "config/robot.hpp"
#include "firmware/tools/wheels/wheels_options.hpp"
#include "hal/api/can_bus.hpp"
#include "hal/api/clock.hpp"
#include "hal/api/digital_io.hpp"

namespace ivo::firmware::wheels {

class World {
 public:
  virtual ~World() = default;

  /// Refuses options that do not fit together, a robot file that is wrong, an interface that cannot be used.
  /// To turn wheels it hears the robot's own COB-IDs alone and reads its stop inputs; to look about it hears all.
  enum class Purpose : std::uint8_t { kLook, kTurn };
  [[nodiscard]] static Result<std::unique_ptr<World>> open(const Options& options, Purpose purpose);

  [[nodiscard]] virtual hal::CanBus& bus() noexcept = 0;
  [[nodiscard]] virtual hal::Clock& clock() noexcept = 0;
  /// Emergency stop and bumpers; null where none are read. Beside simulated drives none is ever pressed.
  [[nodiscard]] virtual hal::DigitalInputs* inputs() noexcept = 0;
  /// After each cycle, before the sleep: simulated drives live on.
  virtual void after_cycle() noexcept = 0;
  /// For a person: "can0, 1 Mbit/s".
  [[nodiscard]] virtual std::string description() const = 0;

  [[nodiscard]] const Robot& robot() const noexcept { return robot_; }
  /// Where the robot's figures are from: a path, or that they are built in.
  [[nodiscard]] const std::string& robot_source() const noexcept { return robot_source_; }

 protected:
  World(Robot robot, std::string source) : robot_(std::move(robot)), robot_source_(std::move(source)) {}

 private:
  Robot robot_;
  std::string robot_source_;
};

}  // namespace ivo::firmware::wheels
