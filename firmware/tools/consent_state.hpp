// Whose consent counts: what was asked or said before the robot got ready, or before it was kept from that, does not.
#pragma once

#include <cstdint>
#include <utility>

#include "firmware/loop/loop_status.hpp"

namespace ivo::firmware {

class ConsentState {
 public:
  /// `beforehand`: --yes.
  explicit ConsentState(bool beforehand) noexcept : beforehand_(beforehand) {}

  /// With each status, before anything is asked. True when a question or an answer is void: the robot is not ready any
  /// more, as when a stop input is pressed. Whoever releases that is not to set the robot off by it.
  [[nodiscard]] bool withdrawn_by(const LoopStatus& status) noexcept {
    const bool held = status.stop_held.reason != drivers::DriveFaultReason::kNone;
    if (held && status.mode != Mode::kPlanning) {
      beforehand_ = false;
    }
    // It may have been kept from being ready for less time than passes from one status that is seen to the next.
    const bool again = std::exchange(times_ready_, status.times_ready) != status.times_ready && status.times_ready > 1;
    const bool paused = std::exchange(pauses_, status.pauses) != status.pauses;
    beforehand_ = beforehand_ && !again && !paused;
    return (status.mode == Mode::kStarting || again || paused) && forget();
  }
  /// A fault is being cleared: what was agreed to ended with it.
  void fault_cleared() noexcept {
    beforehand_ = false;
    after_fault_ = true;
    (void)forget();
  }

  /// Nobody needs to be asked.
  [[nodiscard]] bool beforehand() const noexcept { return beforehand_; }
  [[nodiscard]] bool after_fault() const noexcept { return after_fault_; }
  /// True once, until it is withdrawn: the question is to be put.
  [[nodiscard]] bool ask() noexcept { return !std::exchange(asked_, true); }
  /// What was said cannot count.
  void ask_again() noexcept { (void)forget(); }
  /// `told`: the loop has taken the answer.
  void answer(bool told) noexcept { answered_ = told; }
  [[nodiscard]] bool answered() const noexcept { return answered_; }

 private:
  bool forget() noexcept {
    const bool asked = std::exchange(asked_, false);
    return std::exchange(answered_, false) || asked;
  }

  std::uint32_t times_ready_ = 0;
  std::uint32_t pauses_ = 0;
  bool beforehand_;
  bool after_fault_ = false;
  bool asked_ = false;
  bool answered_ = false;
};

}  // namespace ivo::firmware
