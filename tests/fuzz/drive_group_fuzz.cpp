// Four drives that start up and turn, and then whatever anybody may put on their bus, take from it or ask of the group,
// at any time. What the group and the door behind it let out is judged frame by frame.
#include <array>
#include <chrono>

#include "config/rates.hpp"
#include "drivers/drive_group.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "firmware/safety/guarded_bus.hpp"
#include "hal/sim/virtual_bus.hpp"
#include "tests/fuzz/command_oracle.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/robots.hpp"

namespace {

using namespace ivo;
using fuzz::require;

constexpr int kMostCyclesToIt = 5000;
constexpr int kMostSteps = 40;
constexpr int kMostCyclesAStep = 12;

/// Between door and bus. Loses what it is told to lose.
class Street final : public hal::CanBus {
 public:
  Street(hal::CanBus& inner, const Robot& robot) : inner_(inner), robot_(robot) {}

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override {
    return inner_.receive(frames, now);
  }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override {
    for (const hal::CanFrame& frame : frames) {
      for (std::size_t drive = 0; drive < robot_.drives.size(); ++drive) {
        if (const auto command = fuzz::commanded(robot_, drive, frame)) {
          require(fuzz::in_range(robot_, *command), "no command is out of range");
          require(may_move || !fuzz::moves(*command), "no command that moves leaves without permit and enable");
          require(enabled || command->radps == 0.0, "no target leaves unless all four drives are enabled");
        }
      }
    }
    return inner_.send(frames.first(std::min(frames.size(), room)), now);
  }
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return inner_.counters(); }

  bool may_move = false;
  bool enabled = false;
  std::size_t room = 64;  // frames of a send that get through

 private:
  hal::CanBus& inner_;
  const Robot& robot_;
};

struct World {
  explicit World(const Robot& robot_parameters) : robot(robot_parameters) {
    drives.open();
    group.open(now);
  }

  void cycle(bool enable, bool permit, const drivers::WheelTargets& targets) {
    std::array<hal::ReceivedFrame, 64> frames;
    const std::size_t count = door.receive(frames, now);
    for (std::size_t i = 0; i < count; ++i) {
      group.on_frame(frames[i]);
    }
    const drivers::GroupFeedback& seen = group.update(now);
    street.may_move = enable && permit;
    street.enabled = seen.state == drivers::GroupState::kEnabled;
    door.permit_motion(permit);
    group.write(now, enable, targets);
    now += robot.cycle;
    drives.update(now);
  }

  Robot robot;
  hal::VirtualBus bus;
  Street street{bus.port(0), robot};
  firmware::GuardedBus door{street, robot};
  drivers::SimDrives drives{bus.port(1), robot, drivers::SimDrives::TimeFrom::kClock};
  drivers::DriveGroup group{door, robot};
  Instant now{};
};

void run(World& world, int cycles, bool enable, bool permit, const drivers::WheelTargets& targets) {
  for (int i = 0; i < cycles; ++i) {
    world.cycle(enable, permit, targets);
  }
}

bool run_until(World& world, drivers::GroupState state, bool enable, const drivers::WheelTargets& targets) {
  for (int i = 0; i < kMostCyclesToIt && world.group.feedback().state != state; ++i) {
    world.cycle(enable, enable, targets);
  }
  return world.group.feedback().state == state;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  World world{fuzz::robot_of(input.up_to(1))};
  bool enable = false;
  bool permit = true;
  drivers::WheelTargets targets;
  // Most inputs meet drives that turn; the others a start-up.
  if (input.up_to(3) != 0) {
    require(run_until(world, drivers::GroupState::kReady, false, targets), "drives that nobody disturbs start up");
    enable = true;
    targets.radps.fill(2.0);
    require(run_until(world, drivers::GroupState::kEnabled, true, targets), "drives that nobody disturbs are enabled");
  }
  for (int step = 0; step < kMostSteps && !input.empty(); ++step) {
    switch (input.up_to(11)) {
      case 0:
      case 1:
      case 2:
      case 3: {  // a stranger's frame, mostly in a drive's name
        static constexpr std::array<std::uint16_t, 8> kFunctions = {0x080, 0x180, 0x580, 0x700,
                                                                    0x000, 0x200, 0x600, 0x300};
        const auto function = kFunctions[input.up_to(kFunctions.size() - 1)];
        const hal::CanFrame frame = input.frame(static_cast<std::uint16_t>(function + input.up_to(5)));
        (void)world.bus.port(2).send({&frame, 1}, world.now);
        break;
      }
      case 4:
        enable = input.up_to(1) == 1;
        break;
      case 5:
        permit = input.up_to(1) == 1;
        break;
      case 6:
        targets.radps[input.up_to(3)] = input.take<double>();
        break;
      case 7: {
        auto& script = world.drives.drive(static_cast<Wheel>(input.up_to(3))).script();
        const std::array<Instant*, 5> scripted = {&script.silent_from, &script.feedback_lost_from,
                                                  &script.heartbeat_lost_from, &script.reboot_at, &script.fault_at};
        *scripted[input.up_to(4)] = input.up_to(1) == 1 ? world.now : drivers::SimScript::kNever;
        break;
      }
      case 8:
        world.bus.set_state(0, static_cast<hal::BusState>(input.up_to(6)));
        break;
      case 9:
        world.now += Duration(input.take<std::uint32_t>() % 2'000'000'000);
        break;
      case 10:
        world.street.room = input.up_to(12);
        break;
      default:
        if (input.up_to(1) == 0) {
          world.group.reset_fault();
        } else {
          world.group.stop(world.now);
        }
        break;
    }
    run(world, 1 + static_cast<int>(input.up_to(kMostCyclesAStep - 1)), enable, permit, targets);
  }
  return 0;
}
