// Simulated drives keep the contract that is expected of a real one, over a virtual bus and by frames alone.
#include "tests/contract/drive_contract.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "drivers/eds/shipped_eds.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::contract {
namespace {

/// Four simulated drives and a bench for the second of them.
class SimulatedBench {
 public:
  explicit SimulatedBench(const drivers::EdsDictionary& eds)
      : drives_(bus_.port(1), Robot{}, drivers::SimDrives::TimeFrom::kClock, {}, {&eds, &eds, &eds, &eds}) {
    drives_.open();
  }

  DriveBench bench() {
    return DriveBench({.bus = bus_.port(0),
                       .node_id = 2,
                       .now = [this] { return now_; },
                       .pass =
                           [this](Duration time) {
                             now_ += time;
                             drives_.update(now_);
                           }});
  }

 private:
  hal::VirtualBus bus_;
  drivers::SimDrives drives_;
  Instant now_{};
};

using Eds = const drivers::EdsDictionary& (*)();

/// False when the drive does not have what the check is about.
bool keeps(const Check& check, Eds eds) {
  const auto simulated = std::make_unique<SimulatedBench>(eds());
  DriveBench bench = simulated->bench();
  try {
    bench.reset();
    check.run(bench);
  } catch (const Broken& broken) {
    ADD_FAILURE() << broken.what();
  } catch (const NotThere&) {
    return false;
  }
  return true;
}

class DriveContract : public testing::TestWithParam<Check> {};

TEST_P(DriveContract, IsKeptByAnIvoDrive) {
  EXPECT_TRUE(keeps(GetParam(), drivers::ivo_drive_eds)) << "it has all that the contract speaks of";
}

TEST_P(DriveContract, IsKeptByADriveWithAFixedMapping) { (void)keeps(GetParam(), drivers::fixed_mapping_drive_eds); }

INSTANTIATE_TEST_SUITE_P(OfASimulatedDrive, DriveContract, testing::ValuesIn(drive_contract()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace ivo::contract
