#include "firmware/tools/doctor/can_checks.hpp"

#include "tests/unit/firmware/tools/doctor/machine_folder.hpp"

namespace ivo::firmware::doctor {
namespace {

using hal::BusState;
using hal::InterfaceFacts;
using hal::LinkAnswer;

LinkAnswer can0() {
  InterfaceFacts facts;
  facts.name = "can0";
  facts.kind = InterfaceFacts::Kind::kCan;
  facts.carries_can = true;
  facts.up = true;
  facts.bit_rate_bps = 1'000'000;
  facts.restart_ms = 100;
  facts.queue_frames = 16;
  facts.controller = BusState::kActive;
  facts.counts_errors = true;
  return {LinkAnswer::Outcome::kFound, facts};
}

Group checked(const LinkAnswer& answer) {
  Group group = can_checks("can0", answer, Robot{});
  expect_remedies(group);
  return group;
}

TEST(CanChecks, AnInterfaceThatIsSetUpIsWell) {
  const Group group = checked(can0());
  EXPECT_EQ(group.findings.size(), 7U);
  for (const Finding& finding : group.findings) {
    EXPECT_EQ(finding.state, State::kOk) << finding.check;
  }
  EXPECT_TRUE(usable(can0(), Robot{}));
}

TEST(CanChecks, OneThatNobodyNamedIsNotChecked) {
  const Group group = can_checks("", {}, Robot{});
  ASSERT_EQ(group.findings.size(), 1U);
  EXPECT_EQ(group.findings[0].state, State::kNotChecked);
}

TEST(CanChecks, WhatIsMissingOrCarriesNoCanIsAFaultAndNoMoreIsSaid) {
  LinkAnswer answer;
  answer.outcome = LinkAnswer::Outcome::kMissing;
  EXPECT_EQ(checked(answer).findings.size(), 1U);
  EXPECT_EQ(of(checked(answer), "interface").state, State::kFault);
  EXPECT_FALSE(usable(answer, Robot{}));
  answer = can0();
  answer.facts.carries_can = false;
  EXPECT_EQ(checked(answer).findings.size(), 1U);
  EXPECT_EQ(of(checked(answer), "interface").state, State::kFault);
  answer.outcome = LinkAnswer::Outcome::kNotTold;
  EXPECT_EQ(of(checked(answer), "interface").state, State::kNotChecked);
}

TEST(CanChecks, AVirtualOneIsNamedAsSuchAndHasNoHardwareToCheck) {
  LinkAnswer answer = can0();
  answer.facts.kind = InterfaceFacts::Kind::kVcan;
  answer.facts.bit_rate_bps = 0;
  answer.facts.queue_frames = 1000;
  answer.facts.controller.reset();
  const Group group = checked(answer);
  EXPECT_EQ(of(group, "interface").state, State::kWarning);
  EXPECT_EQ(group.findings.back().state, State::kNotChecked);
  EXPECT_TRUE(usable(answer, Robot{}));
}

TEST(CanChecks, OneThatIsDownGetsTheCommandThatBringsItUp) {
  LinkAnswer answer = can0();
  answer.facts.up = false;
  answer.facts.controller.reset();
  EXPECT_EQ(of(checked(answer), "link").state, State::kFault);
  EXPECT_EQ(of(checked(answer), "link").remedy.find("`ip link set can0 up`"), 0U);
  EXPECT_EQ(of(checked(answer), "controller state").state, State::kNotChecked);
  EXPECT_FALSE(usable(answer, Robot{}));
  answer.facts.bit_rate_bps = 0;
  EXPECT_EQ(of(checked(answer), "link").remedy.find(hal::command_for_bit_rate("can0", 1'000'000)), 0U);
}

TEST(CanChecks, AnotherBitRateThanTheRobotsIsAFault) {
  LinkAnswer answer = can0();
  answer.facts.bit_rate_bps = 500'000;
  const Finding found = of(checked(answer), "bit rate");
  EXPECT_EQ(found.state, State::kFault);
  EXPECT_EQ(found.found, "500 kbit/s; expected the robot's 1000 kbit/s");
  EXPECT_EQ(found.remedy, hal::command_for_bit_rate("can0", 1'000'000));
  EXPECT_FALSE(usable(answer, Robot{}));
}

TEST(CanChecks, AQueueHoldsACycleAndNotManyMore) {
  LinkAnswer answer = can0();
  EXPECT_EQ(frames_at_once(Robot{}), 6U);  // SYNC, four targets, a heartbeat
  for (const auto& [frames, state] :
       {std::pair(5U, State::kFault), std::pair(6U, State::kOk), std::pair(32U, State::kOk),
        std::pair(33U, State::kWarning), std::pair(1000U, State::kWarning)}) {
    answer.facts.queue_frames = frames;
    EXPECT_EQ(of(checked(answer), "queue length").state, state) << frames;
  }
  Robot shared;
  shared.pdo_layout = PdoLayout::kShared;
  EXPECT_EQ(frames_at_once(shared), 8U);  // SYNC, two of targets, four controlwords, a heartbeat
}

TEST(CanChecks, WhatIsToLastIsPutIntoFilesThatMatchTheInterfaceAndComeBeforeTheDefaults) {
  LinkAnswer answer = can0();
  answer.facts.queue_frames = 1000;
  answer.facts.restart_ms = 0;
  answer.facts.up = false;
  EXPECT_NE(of(checked(answer), "queue length")
                .remedy.find("; at each boot: [Match] OriginalName=can0, [Link] TransmitQueueLength=32 in "
                             "/etc/systemd/network/60-ivo-can0.link"),
            std::string::npos);
  EXPECT_NE(of(checked(answer), "after bus-off")
                .remedy.find("; at each boot: [Match] Name=can0, [CAN] RestartSec=100ms in "
                             "/etc/systemd/network/60-ivo-can0.network"),
            std::string::npos);
  EXPECT_NE(of(checked(answer), "link").remedy.find("[Match] Name=can0, [CAN] BitRate=1000000 in "), std::string::npos);
}

TEST(CanChecks, OneThatStaysOffAfterBusOffIsWarnedOf) {
  LinkAnswer answer = can0();
  answer.facts.restart_ms = 0;
  EXPECT_EQ(of(checked(answer), "after bus-off").state, State::kWarning);
}

TEST(CanChecks, EachStateOfTheControllerIsJudged) {
  LinkAnswer answer = can0();
  for (const auto& [bus, state] :
       {std::pair(BusState::kWarning, State::kWarning), std::pair(BusState::kPassive, State::kFault),
        std::pair(BusState::kOff, State::kFault)}) {
    answer.facts.controller = bus;
    EXPECT_EQ(of(checked(answer), "controller state").state, state) << hal::name_of(bus);
  }
  answer.facts.controller.reset();
  EXPECT_EQ(of(checked(answer), "controller state").state, State::kNotChecked);
}

TEST(CanChecks, ErrorsOfLateAreShown) {
  LinkAnswer answer = can0();
  answer.facts.receive_errors = 3;
  EXPECT_EQ(of(checked(answer), "error counters").state, State::kWarning);
  EXPECT_EQ(of(checked(answer), "error counters").found, "transmit 0, receive 3: frames were disturbed of late");
  answer.facts.transmit_errors = 128;
  EXPECT_EQ(of(checked(answer), "error counters").found, "transmit 128, receive 3; expected less than 96");
  answer.facts.counts_errors = false;
  EXPECT_EQ(of(checked(answer), "error counters").state, State::kNotChecked);
}

}  // namespace
}  // namespace ivo::firmware::doctor
