// The last door before the bus, with any frames and any order of permits, receptions and sends.
//
// Compiled with IVO_DOOR_LEFT_OPEN it has no door: then this must find it (see CMakeLists.txt).
#include <array>

#include "firmware/safety/guarded_bus.hpp"
#include "tests/fuzz/command_oracle.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/robots.hpp"

namespace {

using namespace ivo;
using fuzz::require;

/// The bus behind the door: judges what gets through.
class Street final : public hal::CanBus {
 public:
  explicit Street(const Robot& robot) : robot_(robot) {}

  std::size_t receive(std::span<hal::ReceivedFrame> /*frames*/, Instant /*now*/) noexcept override { return 0; }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant /*now*/) noexcept override {
    for (const hal::CanFrame& frame : frames) {
      judge(frame);
    }
    last_ = frames;
    return frames.size();
  }
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return last_; }
  [[nodiscard]] hal::BusState state() const noexcept override { return hal::BusState::kActive; }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return {}; }

  void permit(bool permitted) {
    enables_left_.fill(permitted);
    targets_left_.fill(permitted);
  }

 private:
  void judge(const hal::CanFrame& frame) {
    require(frame.size <= 8 && frame.id <= 0x7FF, "a frame that left is a frame");
    for (std::size_t drive = 0; drive < robot_.drives.size(); ++drive) {
      const auto command = fuzz::commanded(robot_, drive, frame);
      if (!command.has_value()) {
        continue;
      }
      require(fuzz::in_range(robot_, *command), "no target beyond the wheel's largest speed has left");
      if (command->enables) {
        require(enables_left_[drive], "no frame that enables a drive has left without a permit");
        enables_left_[drive] = false;
      }
      if (command->radps != 0.0) {
        require(targets_left_[drive], "no frame that moves a wheel has left without a permit");
        targets_left_[drive] = false;
      }
    }
    // By SDO: 6040h and 60FFh are written with 0 or not at all.
    const bool download = (frame.data[0] & 0xE0) == 0x20;
    const unsigned index = frame.data[1] | frame.data[2] << 8U;
    if (frame.id > 0x600 && frame.id < 0x680 && download && (index == 0x6040 || index == 0x60FF)) {
      require((frame.data[0] & 2) != 0 && fuzz::signed_32_at(frame, 4) == 0, "no motion has left by SDO");
    }
  }

  const Robot& robot_;
  std::span<const hal::CanFrame> last_;
  std::array<bool, kWheels> enables_left_{};
  std::array<bool, kWheels> targets_left_{};
};

std::uint16_t interesting_id(fuzz::Input& input) {
  static constexpr std::array<std::uint16_t, 12> kFunctions = {0x000, 0x080, 0x180, 0x200, 0x280, 0x300,
                                                               0x400, 0x500, 0x580, 0x600, 0x700, 0x780};
  return static_cast<std::uint16_t>(kFunctions[input.up_to(kFunctions.size() - 1)] + input.up_to(5));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  const Robot& robot = fuzz::robot_of(input.up_to(1));
  Street street(robot);
#ifdef IVO_DOOR_LEFT_OPEN
  Street& door = street;
#else
  firmware::GuardedBus door(street, robot);
#endif
  std::array<hal::CanFrame, 4> frames{};
  std::size_t held = 0;
  while (!input.empty()) {
    switch (input.up_to(4)) {
      case 0: {
        const bool permitted = input.up_to(1) == 1;
#ifndef IVO_DOOR_LEFT_OPEN
        door.permit_motion(permitted);
#endif
        street.permit(permitted);
        break;
      }
      case 1: {
        std::array<hal::ReceivedFrame, 1> none;
        (void)door.receive(none, Instant{});
        street.permit(false);
        break;
      }
      case 2:
        (void)door.send(std::span(frames).first(held), Instant{});
        held = 0;
        break;
      default:
        frames[held] = input.frame(interesting_id(input));
        held = (held + 1) % frames.size();
        break;
    }
  }
  return 0;
}
