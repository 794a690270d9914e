#include "firmware/tools/doctor/disk_checks.hpp"

#include "tests/unit/firmware/tools/doctor/machine_folder.hpp"

namespace ivo::firmware::doctor {
namespace {

using std::chrono_literals::operator""ms;

DiskFacts good() {
  return {.folder = "/var/lib/ivo",
          .free_bytes = 10'240 * kMiB,
          .in_memory = false,
          .writes = {1ms, 2ms, 9ms},
          .refusal = {}};
}

Group checked(const DiskFacts& facts) {
  Group group = disk_checks(facts);
  expect_remedies(group);
  return group;
}

TEST(DiskChecks, RoomAndAQuickDiskAreWell) {
  const Group group = checked(good());
  EXPECT_EQ(of(group, "room").state, State::kOk);
  EXPECT_EQ(of(group, "room").found, "10.0 GiB free in /var/lib/ivo");
  EXPECT_EQ(of(group, "write and sync").state, State::kOk);
  EXPECT_EQ(of(group, "write and sync").found, "4 KiB in 2.00 ms, at worst 9.00 ms (of 3)");
}

TEST(DiskChecks, LittleRoomIsWarnedOfAndNoneIsAFault) {
  DiskFacts facts = good();
  for (const auto& [mib, state] : {std::pair(1024U, State::kOk), std::pair(1023U, State::kWarning),
                                   std::pair(100U, State::kWarning), std::pair(99U, State::kFault)}) {
    facts.free_bytes = mib * kMiB;
    EXPECT_EQ(of(checked(facts), "room").state, state) << mib;
  }
}

TEST(DiskChecks, TheSlowestWriteCounts) {
  DiskFacts facts = good();
  for (const auto& [late, state] :
       {std::pair(99ms, State::kOk), std::pair(100ms, State::kWarning), std::pair(1000ms, State::kFault)}) {
    facts.writes.back() = late;
    EXPECT_EQ(of(checked(facts), "write and sync").state, state) << late.count();
  }
}

TEST(DiskChecks, AFolderThatRefusesIsAFaultWithTheReason) {
  DiskFacts facts = good();
  facts.writes.clear();
  facts.refusal = "Permission denied";
  EXPECT_EQ(of(checked(facts), "write and sync").state, State::kFault);
  EXPECT_EQ(of(checked(facts), "write and sync").found, "/var/lib/ivo: Permission denied");
}

TEST(DiskChecks, WhatIsInMemoryIsSaidToBe) {
  DiskFacts facts = good();
  facts.in_memory = true;
  EXPECT_EQ(of(checked(facts), "kept").state, State::kWarning);
}

TEST(DiskTrial, TriesTheNearestFolderThatIsThereAndLeavesNothing) {
  const ScratchFolder scratch;
  const Result<DiskFacts> facts = try_disk(scratch.path("not/there/yet"));
  ASSERT_TRUE(facts) << facts.error().message;
  EXPECT_EQ(facts.value().folder, scratch.path());
  EXPECT_FALSE(facts.value().writes.empty()) << facts.value().refusal;
  EXPECT_TRUE(std::ranges::is_sorted(facts.value().writes));
  EXPECT_GT(facts.value().free_bytes, 0U);
  EXPECT_TRUE(scratch.names().empty());
}

TEST(DiskTrial, RefusesAFileWhereAFolderShouldBe) {
  const ScratchFolder scratch;
  const std::string file = scratch.put("file", "x");
  for (const std::string& path : {file, file + "/below"}) {
    const Result<DiskFacts> facts = try_disk(path);
    ASSERT_FALSE(facts) << path;
    EXPECT_NE(facts.error().message.find(file + " is no folder"), std::string::npos) << facts.error().message;
  }
}

}  // namespace
}  // namespace ivo::firmware::doctor
