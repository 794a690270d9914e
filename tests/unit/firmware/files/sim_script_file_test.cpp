#include "firmware/files/sim_script_file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"

namespace ivo::firmware {
namespace {

using drivers::SimFault;
using drivers::SimScript;

const std::string kScript =
    "noise_counts = 2\nseed = 7\n"                                                                 // 1, 2
    "[[at]]\nt_s = 2.5\ndrive = \"rear_left\"\nfault = \"slow_sdo\"\nvalue = 20\n"                 // 3 to 7
    "[[at]]\nt_s = 3\ndrive = \"all\"\nfault = \"silent\"\non = false\n"                           // 8 to 12
    "[[at]]\nt_s = 4\ndrive = \"front_right\"\nfault = \"sdo_abort\"\nindex = 0x6060\nsub = 1\n";  // 13 to 18

std::string complaint_about_script(std::string_view from, std::string_view to) {
  const ScratchFolder folder;
  return replaced(message_of(read_sim_script(folder.put("s.toml", replaced(kScript, from, to)))), folder.path() + "/",
                  "");
}

TEST(SimScriptFile, ReadsEveryField) {
  const ScratchFolder folder;
  const auto scripts = read_sim_script(folder.put("s.toml", kScript));
  ASSERT_TRUE(scripts.ok()) << scripts.error().message;
  const SimScript& rear_left = scripts.value()[2];
  EXPECT_EQ(rear_left.noise_counts, 2U);
  EXPECT_EQ(rear_left.seed, 7U);
  ASSERT_EQ(rear_left.events.size(), 2U);
  EXPECT_EQ(rear_left.events[0].at, Instant(std::chrono::milliseconds(2500)));
  EXPECT_EQ(rear_left.events[0].fault, SimFault::kSlowSdo);
  EXPECT_EQ(rear_left.events[0].value, 20U);
  EXPECT_TRUE(rear_left.events[0].on);
  EXPECT_EQ(rear_left.events[1].fault, SimFault::kSilent);
  EXPECT_FALSE(rear_left.events[1].on);
  const SimScript& front_right = scripts.value()[1];
  ASSERT_EQ(front_right.events.size(), 2U);
  EXPECT_EQ(front_right.events[1].object, (drivers::ObjectAddress{0x6060, 1}));
  EXPECT_EQ(scripts.value()[3].events.size(), 1U);
}

TEST(SimScriptFile, MayBeEmpty) {
  const ScratchFolder folder;
  const auto scripts = read_sim_script(folder.put("s.toml", ""));
  ASSERT_TRUE(scripts.ok()) << scripts.error().message;
  EXPECT_TRUE(scripts.value()[0].events.empty());
}

TEST(SimScriptFile, RefusesByFileLineAndKey) {
  EXPECT_EQ(complaint_about_script("\"slow_sdo\"", "\"slow\"").substr(0, 69),
            "s.toml:6: at[0].fault: \"slow\" is unknown; expected one of silent, no_");
  EXPECT_EQ(
      complaint_about_script("\"rear_left\"", "\"left\""),
      "s.toml:5: at[0].drive: \"left\" is unknown; expected \"front_left\" or \"front_right\" or \"rear_left\" or "
      "\"rear_right\" or \"all\"");
  EXPECT_EQ(complaint_about_script("t_s = 2.5", "t_s = -1").substr(0, 21), "s.toml:4: at[0].t_s: ");
  EXPECT_EQ(complaint_about_script("value = 20", "value = 4294967296").substr(0, 23), "s.toml:7: at[0].value: ");
  EXPECT_EQ(complaint_about_script("value = 20", "valu = 20").substr(0, 22), "s.toml:7: at[0].valu: ");
  EXPECT_EQ(complaint_about_script("drive = \"all\"\n", "").substr(0, 10), "s.toml:8: ");
  EXPECT_EQ(complaint_about_script("seed = 7", "seed = 0").substr(0, 16), "s.toml:2: seed: ");
}

TEST(SimScriptFile, RefusesMoreEventsThanADriveHolds) {
  std::string many;
  for (std::size_t i = 0; i <= SimScript::kEvents; ++i) {
    many += "[[at]]\nt_s = 1\ndrive = \"front_left\"\nfault = \"silent\"\n";
  }
  const ScratchFolder folder;
  const std::string message = message_of(read_sim_script(folder.put("s.toml", many)));
  EXPECT_NE(message.find("s.toml:129: at[32]: one event too many of this drive; expected at most 32"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace ivo::firmware
