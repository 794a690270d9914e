#include "firmware/tools/dialogue/plan_notice.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ivo::firmware {
namespace {

using planner::RefusalCode;

class PlanNoticeTest : public testing::Test {
 protected:
  PlanNoticeTest() {
    inputs_.file.mission.agents.resize(2);
    inputs_.file.mission.agents[0].name = "IVO";
    inputs_.file.mission.agents[1].name = "Ana";
    slots_[1] = {4, 31};
  }
  PlanNotice notice(const planner::Refusal& refusal) const { return notice_of(refusal, inputs_, slots_); }

  MissionInputs inputs_;
  PreferredSlots slots_;
};

TEST_F(PlanNoticeTest, SaysByCodeAndNameWhoCannotSetOff) {
  struct Row {
    RefusalCode code;
    std::string word;
  };
  for (const auto& [code, word] :
       {Row{RefusalCode::kStartOutsideMap, "start_outside_map"}, Row{RefusalCode::kStartBlocked, "start_blocked"},
        Row{RefusalCode::kStartRestricted, "start_restricted"},
        Row{RefusalCode::kNoMassObservable, "nothing_in_reach"}}) {
    const PlanNotice said = notice({.code = code, .agent = 1});
    EXPECT_EQ(said.code, word);
    EXPECT_EQ(said.agent, 1);
    EXPECT_FALSE(said.slot.has_value());
    EXPECT_EQ(said.text.rfind("Ana ", 0), 0U) << said.text;
    EXPECT_NE(said.text.find("; expected "), std::string::npos) << said.text;
    EXPECT_EQ(said.text.find('\n'), std::string::npos);
  }
}

TEST_F(PlanNoticeTest, SaysWhichAreaBySlotAndNotByPlace) {
  const PlanNotice second = notice({.code = RefusalCode::kAreaWithoutMass, .agent = 1, .area = 1});
  EXPECT_EQ(second.code, "area_without_mass");
  EXPECT_EQ(second.slot, 31);
  EXPECT_EQ(second.agent, 1);
  EXPECT_EQ(notice({.code = RefusalCode::kAreaWithoutMass, .agent = 1, .area = 0}).slot, 4);
  EXPECT_FALSE(notice({.code = RefusalCode::kAreaWithoutMass, .agent = 0, .area = 0}).slot.has_value())
      << "none was drawn for it";
}

TEST_F(PlanNoticeTest, SaysThatNothingIsLeftAndBlamesNobody) {
  const PlanNotice said = notice({.code = RefusalCode::kPriorWithoutMass});
  EXPECT_EQ(said.code, "nothing_left");
  EXPECT_FALSE(said.agent.has_value());
  EXPECT_FALSE(said.slot.has_value());
}

TEST_F(PlanNoticeTest, SaysOfAnythingElseWhatTheMissionsReaderWouldSay) {
  const PlanNotice said = notice({.code = RefusalCode::kTooManyNodes, .value = 9000, .limit = 5000});
  EXPECT_EQ(said.code, "refused");
  EXPECT_FALSE(said.text.empty());
}

}  // namespace
}  // namespace ivo::firmware
