#include "firmware/tools/resume/search_world.hpp"

#include <gtest/gtest.h>

namespace ivo::firmware {
namespace {

using Time = RunWorld::Time;

std::string on(const char* can, Time time) {
  RunOptions options;
  options.can = can;
  return search_world(options, time);
}

TEST(SearchWorld, SimulatedInterfacesAreOneKindAndRealOnesAreToldByName) {
  EXPECT_EQ(on("", Time::kSimulated), "the virtual bus");
  EXPECT_EQ(on("vcan0", Time::kRealOnSimulatedBus), "a simulated interface");
  EXPECT_EQ(on("vcan1", Time::kSimulated), "a simulated interface") << "in lock step";
  EXPECT_EQ(on("can0", Time::kReal), "can0");
}

TEST(SearchWorld, ASearchIsTakenUpOnlyWhereItWasBegun) {
  const std::string worlds[] = {on("", Time::kSimulated), on("vcan0", Time::kRealOnSimulatedBus),
                                on("can0", Time::kReal), on("can1", Time::kReal)};
  for (const std::string& kept : worlds) {
    for (const std::string& now : worlds) {
      EXPECT_EQ(other_world(kept, now).empty(), kept == now) << kept << ", " << now;
    }
  }
  EXPECT_EQ(other_world("the virtual bus", "can0"),
            "a search on the virtual bus was cut off here; expected it to be taken up there, not on can0");
}

}  // namespace
}  // namespace ivo::firmware
