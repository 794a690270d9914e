// How full the bus is while the robot drives: as its layout promises, and as it was.
#include <array>
#include <memory>
#include <span>
#include <string>

#include "config/limits.hpp"
#include "drivers/canopen/bus_load.hpp"
#include "firmware/tools/bench/can/bus_figures.hpp"
#include "firmware/tools/bench/can/fault_rig.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr double kMostLoad = 50.0;  // percent, of the worst case
constexpr Duration kDriven = std::chrono::seconds(10);
constexpr Duration kQuickDriven = std::chrono::seconds(2);

Result<drivers::LoadMeter::Figures> measured(Duration driven) {
  Result<std::unique_ptr<FaultRig>> made = FaultRig::make({});
  if (!made) {
    return made.error();
  }
  FaultRig& rig = *made.value();
  if (!rig.drive_at_speed()) {
    return Error{"the robot did not come to drive"};
  }
  Result<hal::SocketCanBus> listener = hal::SocketCanBus::open(FaultRig::kMasterSide, {.confirm = false});
  if (!listener) {
    return listener.error();
  }
  drivers::LoadMeter meter(rig.robot().bit_rate_bps);
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames;
  for (const Instant end = rig.now() + driven; rig.now() < end;) {
    const Instant now = rig.now();
    rig.cycle();
    const std::size_t count = listener.value().receive(frames, now);
    for (const hal::ReceivedFrame& received : std::span(frames).first(count)) {
      meter.add(now, received.frame);
    }
  }
  return meter.figures();
}

}  // namespace

void bus_load(const Options& options, Sheet& sheet) {
  sheet.clock("simulated time, in lock step");
  const Robot robot;
  const drivers::BusSchedule schedule = drivers::schedule_of(robot);
  const drivers::BusLoad load = drivers::load_of(schedule.span(), robot.bit_rate_bps);
  const std::string name = "bus load while driving";
  const Result<drivers::LoadMeter::Figures> figures = measured(options.quick ? kQuickDriven : kDriven);
  if (!figures) {
    return sheet.skip(name, figures.error().message);
  }
  sheet.add(name, "computed without stuffing", load.unstuffed * 100, "%");
  sheet.add(name, "computed, worst", load.worst * 100, "%", Target{kMostLoad});
  sheet.add(name, "measured", figures.value().mean * 100, "%", Target{load.worst * 100});
  sheet.add(name, "measured, worst 10 ms", figures.value().worst_10ms * 100, "%");
  sheet.add(name, "frames", static_cast<double>(figures.value().frames), "");
}

}  // namespace ivo::firmware::bench
