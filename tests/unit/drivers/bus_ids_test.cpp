#include "drivers/canopen/bus_ids.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

TEST(BusIds, AreAscendingAndEachOnce) {
  const BusIds ids = bus_ids(test_robot());
  EXPECT_EQ(ids.size(), kBusIds);
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  EXPECT_EQ(std::set<std::uint16_t>(ids.begin(), ids.end()).size(), ids.size());
}

TEST(BusIds, HoldEveryObjectOfEachDriveAndNoOtherNodes) {
  const BusIds ids = bus_ids(test_robot());
  for (int id = 0; id <= 0x7FF; ++id) {
    const int node = id & 0x7F;
    const int function = id & 0x780;
    const bool of_drive =
        node >= 1 && node <= 4 && function >= 0x080 && function != 0x100 && function != 0x780 && function != 0x680;
    const bool expected = of_drive || id == 0x000 || id == 0x080 || id == 0x77F;
    const bool held = std::find(ids.begin(), ids.end(), id) != ids.end();
    EXPECT_EQ(held, expected) << std::hex << id;
  }
}

TEST(BusIds, HoldEachIdOnceThoughADriveHadTheMastersNodeId) {
  Robot robot = test_robot();
  robot.master_node_id = robot.drives[0].node_id;
  EXPECT_EQ(bus_ids(robot).size(), kBusIds - 1);
}

TEST(BusIds, HoldEveryFrameOfARunThatMoves) {
  Rig rig;
  const BusIds ids = bus_ids(rig.robot);
  ASSERT_TRUE(rig.drive_at(2.0));
  for (const hal::CanFrame& frame : rig.log) {
    EXPECT_NE(std::find(ids.begin(), ids.end(), frame.id), ids.end()) << std::hex << frame.id;
  }
}

}  // namespace
}  // namespace ivo::drivers
