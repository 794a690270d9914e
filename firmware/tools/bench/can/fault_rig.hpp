// The real control loop on the real bus of a kernel, with four simulated drives on a second socket and an injector on a
// third, in lock step: a cycle of the loop, then the drives answer, then a period has passed. Time is simulated; the
// host's clock is not looked at.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/tools/bench/can/delivery.hpp"
#include "firmware/tools/bench/can/injector.hpp"
#include "firmware/tools/bench/can/tapped_bus.hpp"
#include "firmware/tools/bench/scenes.hpp"
#include "hal/linux/socketcan_bus.hpp"
#include "hal/sim/digital_inputs.hpp"

namespace ivo::firmware::bench {

/// A rule of the gateway: `verb` -A adds it, -D deletes it; frames to the drives or from them.
[[nodiscard]] std::vector<std::string> gateway_rule(const std::string& verb, bool to_drives,
                                                    const std::vector<std::string>& more);

/// One thread; about 60,000 cycles are a run's length. The planner is the program's: one rig at a time.
class FaultRig {
 public:
  static constexpr const char* kMasterSide = "vcan0";
  static constexpr const char* kOtherSide = "vcan1";  ///< of the gateway

  struct Options {
    /// The drives are on vcan1, and cangw carries every frame over: what changes frames on the way is the kernel. The
    /// feedback of drive 3, 183h, has a rule of its own.
    bool gateway = false;
    /// kShared: at 1 kHz.
    PdoLayout layout = PdoLayout::kOwn;
    int receive_bytes = 0;  ///< of the loop's queue (SocketCanBus::Options)
  };

  /// The interfaces are as toolchain/vcan makes them; what an earlier rig left on them is undone.
  [[nodiscard]] static Result<std::unique_ptr<FaultRig>> make(const Options& options);

  FaultRig(const FaultRig&) = delete;
  FaultRig& operator=(const FaultRig&) = delete;
  ~FaultRig();

  /// Power on: the drives boot, the loop begins. Nothing has happened before, so that a drive can be spoilt first.
  void power_on();

  const LoopStatus& cycle();
  void run(Duration time);
  /// False when it did not come within `limit`.
  bool run_until(const std::function<bool(FaultRig&)>& condition, Duration limit);
  bool run_until(Mode mode, Duration limit);
  /// From power-on to wheels that have turned at no less than nine tenths of the search's speed for 200 ms.
  bool drive_at_speed();
  /// The operator agrees; true when the wheels turn afterwards.
  bool consent_and_move();

  ControlLoop& loop() { return *loop_; }
  const LoopStatus& status() { return loop_->status(); }
  [[nodiscard]] Instant now() const noexcept { return now_; }
  [[nodiscard]] const Robot& robot() const noexcept { return robot_; }
  drivers::SimDrives& drives() { return *drives_; }
  drivers::SimDrive& drive(Wheel wheel) { return drives_->drive(wheel); }
  Injector& injector() { return injector_; }
  /// Emergency stop and one bumper.
  hal::SimDigitalInputs& inputs() { return inputs_; }
  /// The drives answer, and a period has passed: the end of a cycle, also of one without a loop.
  void pass_period();
  /// The bus that the loop is given.
  TappedBus& tap() noexcept { return tap_; }
  /// What the loop handed to its bus in the last cycle.
  [[nodiscard]] const std::vector<hal::CanFrame>& sent() const noexcept { return tap_.sent(); }

  // To provoke with.
  MeddledBus& meddle() { return meddled_; }
  /// Done before every cycle from now on; none: nothing.
  void each_cycle(std::function<void(FaultRig&)> what) { each_cycle_ = std::move(what); }
  /// The loop's thread hangs: no cycle of it while time and drives go on.
  void hold_loop(bool held) noexcept { held_ = held; }
  /// So many periods pass at once before the next cycle, as when the loop wakes late.
  void be_late(int periods) noexcept { late_ = periods; }
  /// A frame that only this drive hears, as if it had decided so by itself.
  void tell(Wheel wheel, const hal::CanFrame& frame);
  /// A foreign program, at once. What fails is kept for complaint().
  void tool(const std::vector<std::string>& words);
  /// A foreign program that undoes something when the rig ends, whatever comes of it.
  void at_end(const std::vector<std::string>& words) { undo_.push_back(words); }
  /// Why the figures of this rig are worth nothing; empty when they are.
  [[nodiscard]] const std::string& complaint() const noexcept { return complaint_; }

  // What the wheels really do.
  [[nodiscard]] bool at_rest();
  /// Of the fastest wheel, at its rim.
  [[nodiscard]] double rim_speed_mps();

 private:
  FaultRig(const Options& options, const Robot& robot, hal::SocketCanBus master, hal::SocketCanBus drives,
           Injector injector, Delivery delivery);

  void deliver();

  Robot robot_;
  bool gateway_;
  hal::SocketCanBus master_;
  TappedBus tap_;
  hal::SocketCanBus drives_bus_;
  MeddledBus meddled_;
  Injector injector_;
  Delivery delivery_;
  std::optional<drivers::SimDrives> drives_;
  hal::SimDigitalInputs inputs_;
  std::unique_ptr<ControlLoop> loop_;
  std::function<void(FaultRig&)> each_cycle_;
  std::vector<std::vector<std::string>> undo_;
  std::string complaint_;
  Instant now_{};
  bool held_ = false;
  int late_ = 0;
  std::int64_t missed_ = 0;  // periods since the loop's last cycle
};

}  // namespace ivo::firmware::bench
