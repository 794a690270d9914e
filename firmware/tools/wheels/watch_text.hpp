// What was heard, in lines for a person: a picture that is drawn over itself, or a line a change.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "drivers/cia402/statusword.hpp"
#include "firmware/tools/wheels/bus_listener.hpp"

namespace ivo::firmware::wheels {

struct BusView {
  hal::BusState state = hal::BusState::kActive;
  hal::BusCounters counters;
};

/// A line for the bus, a heading, a line a wheel.
[[nodiscard]] std::vector<std::string> watch_picture(const BusListener& heard, const Robot& robot, const BusView& bus,
                                                     Instant now);

/// Remembers what was said last, and says what has become of it.
class ChangeLog {
 public:
  using Say = std::function<void(const std::string&)>;

  ChangeLog(const Robot& robot, Say say) : robot_(robot), say_(std::move(say)) {}
  void update(const BusListener& heard, const BusView& bus, Instant now);

 private:
  struct Said {
    std::optional<drivers::NmtState> state;
    bool heartbeat_lost = false;
    std::uint64_t boot_ups = 0;
    std::optional<drivers::cia402::PowerState> power;
    std::uint64_t emergencies = 0;
  };
  void update_wheel(Wheel wheel, const HeardNode& node, Instant now);

  const Robot& robot_;
  Say say_;
  std::array<Said, kWheels> said_;
  std::optional<hal::BusState> bus_;
  std::uint64_t lost_ = 0;
  bool controller_ = false;
};

}  // namespace ivo::firmware::wheels
