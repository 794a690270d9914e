// Turns one wheel slowly while a key is held: the core of `ivo wheels turn` and `check`. Nothing in it waits,
// allocates, throws or knows a terminal: time, frames and keys are handed in.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "config/limits.hpp"
#include "config/rates.hpp"
#include "config/robot.hpp"
#include "drivers/drive_group.hpp"
#include "firmware/safety/guarded_bus.hpp"
#include "firmware/safety/stop_inputs.hpp"
#include "firmware/tools/wheels/dead_man.hpp"
#include "firmware/tools/wheels/turn_measure.hpp"

namespace ivo::firmware {

/// Which wheel is to turn while the key is held, how fast and how far.
struct TurnOrder {
  Wheel wheel = Wheel::kFrontLeft;
  double radps = 0.0;      ///< at the wheel, positive forward; held within WheelTurner::kFastestRadps, 0 when no number
  double limit_rad = 0.0;  ///< by the drive's position, from the order on: stops there by itself; 0: none
  double expected = 1.0;   ///< times as fast as told, by its position, it was seen to turn: more than twice is too fast
};

enum class TurnPhase : std::uint8_t {
  kStarting,  ///< the drives start up
  kOff,       ///< power off, a key is awaited
  kPowering,  ///< a key is down: power comes up on all four
  kWaiting,   ///< power on, all targets 0
  kTurning,   ///< the wheel speeds up or turns
  kSlowing,   ///< the key was let go, or the limit is near
  kEnding,    ///< power goes off
  kEnded,     ///< no cycle is needed any more
};

/// Why it ended, or ends.
enum class TurnEnd : std::uint8_t {
  kNone,
  kAsked,        ///< another key, a signal, a terminal that went away
  kNobodyThere,  ///< no key for kPatience
  kFault,        ///< TurnStatus::fault
};

struct TurnStatus {
  Instant at{};
  TurnPhase phase = TurnPhase::kStarting;
  DeadMan::State key = DeadMan::State::kReleased;
  Wheel wheel = Wheel::kFrontLeft;
  std::uint32_t order = 0;  ///< number of the order in force, from 1
  bool limit_reached = false;
  TurnMeasure::Result turned;  ///< since the order
  TurnEnd end = TurnEnd::kNone;
  drivers::DriveFault fault;
  bool power_off = true;  ///< the drives have said so
  hal::BusCounters bus;
  hal::BusState bus_state = hal::BusState::kActive;
  std::uint64_t refused_frames = 0;
};

/// All four drives run as in the control loop: DriveGroup behind a GuardedBus, which here lets no target pass beyond
/// kFastestRadps. Power is on, on all four, from the first press of the key until kPowerOffAfter it was let go; the
/// other three have target 0. Each cycle: cycle(). Ends with power off; a drive that does not say so is given up after
/// kGiveUp, with power_off false: it stops by our missing heartbeat.
class WheelTurner {
 public:
  static constexpr double kFastestRadps = 2.0;
  static constexpr double kRampUpRadps2 = 1.0;
  static constexpr double kRampDownRadps2 = 4.0;
  static constexpr Duration kPowerOffAfter = std::chrono::seconds(1);
  static constexpr Duration kPatience = std::chrono::minutes(5);
  static constexpr Duration kGiveUp = rates::kStandstillTimeout + rates::kStateChangeTimeout;

  /// `bus` and `inputs` outlive this. Stop inputs that the robot has and nobody reads count as pressed; one that is
  /// pressed, at any time, is a fault and ends it.
  WheelTurner(hal::CanBus& bus, const Robot& robot, hal::DigitalInputs* inputs = nullptr) noexcept;

  void open(Instant now) noexcept;
  /// From now on; what is held does not count for it.
  void give(const TurnOrder& order) noexcept;

  struct Keys {
    bool hold = false;   ///< the hold key came since the last cycle
    bool other = false;  ///< another key came, which is no end: somebody is there
    bool end = false;    ///< stop, power off, end
  };
  /// `skipped`: periods lost before it; LoopParameters::latch_at of them under power are a fault.
  const TurnStatus& cycle(Instant now, std::int64_t skipped, const Keys& keys) noexcept;

  [[nodiscard]] bool ended() const noexcept { return status_.phase == TurnPhase::kEnded; }
  [[nodiscard]] const TurnStatus& status() const noexcept { return status_; }

 private:
  void drain_bus() noexcept;
  void look_at_drives(std::int64_t late) noexcept;
  void fail(const drivers::DriveFault& fault) noexcept;
  void listen_to_keys(const Keys& keys) noexcept;
  void measure() noexcept;
  void look_for_end(const Keys& keys) noexcept;
  void end(TurnEnd why) noexcept;
  void decide_power() noexcept;
  void choose_speed() noexcept;
  void write() noexcept;
  void publish() noexcept;
  [[nodiscard]] TurnPhase phase() const noexcept;

  GuardedBus bus_;
  drivers::DriveGroup drives_;
  StopInputs stop_inputs_;
  int latch_at_;
  hal::DigitalInputs* inputs_;
  Duration cycle_;
  Duration longest_step_;
  std::array<TurnMeasure::Scale, kWheels> scales_;
  DeadMan key_;
  TurnMeasure measure_;
  TurnOrder order_;
  std::uint32_t orders_ = 0;
  TurnStatus status_;

  // Of the cycle under way.
  Instant now_{};
  Duration dt_{};
  drivers::GroupFeedback wheels_;
  bool enable_ = false;
  bool cut_ = false;  // something was odd: power off, until all four have said so
  bool limit_reached_ = false;
  double told_radps_ = 0.0;          // in the last cycle
  Instant last_key_{};               // of any kind
  std::optional<Instant> last_use_;  // of the power
  TurnEnd end_ = TurnEnd::kNone;
  Instant end_at_{};
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames_{};
};

}  // namespace ivo::firmware
