#include "firmware/tools/dialogue/plan_notice.hpp"

#include <cstddef>

namespace ivo::firmware {
namespace {

std::string who(const planner::Refusal& refusal, const MissionInputs& inputs) {
  return refusal.agent >= 0 ? inputs.file.mission.agents[static_cast<std::size_t>(refusal.agent)].name : "somebody";
}

}  // namespace

PlanNotice notice_of(const planner::Refusal& refusal, const MissionInputs& inputs, const PreferredSlots& slots) {
  using planner::RefusalCode;
  PlanNotice notice;
  if (refusal.agent >= 0) {
    notice.agent = refusal.agent;
  }
  const std::string name = who(refusal, inputs);
  switch (refusal.code) {
    case RefusalCode::kStartOutsideMap:
      notice.code = "start_outside_map";
      notice.text = name + " is outside the map; expected a place on it";
      return notice;
    case RefusalCode::kStartBlocked:
      notice.code = "start_blocked";
      notice.text = name + " stands too near to an obstacle; expected room for the footprint";
      return notice;
    case RefusalCode::kStartRestricted:
      notice.code = "start_restricted";
      notice.text = name + " stands in a no-go area; expected one that leaves them out";
      return notice;
    case RefusalCode::kPriorWithoutMass:
      notice.code = "nothing_left";
      notice.text = "all that may hold the object has been searched; expected something that is left";
      return notice;
    case RefusalCode::kNoMassObservable:
      notice.code = "nothing_in_reach";
      notice.text = name + " sees no place that may hold the object from anywhere they can go; expected a way to one";
      return notice;
    case RefusalCode::kAreaWithoutMass: {
      notice.code = "area_without_mass";
      notice.text = "an area of " + name +
                    " covers nothing that may hold the object and that they can see; expected one that does";
      const auto& of_agent = slots[static_cast<std::size_t>(refusal.agent)];
      if (static_cast<std::size_t>(refusal.area) < of_agent.size()) {
        notice.slot = of_agent[static_cast<std::size_t>(refusal.area)];
      }
      return notice;
    }
    default:
      notice.code = "refused";
      notice.text = sentence_of(refusal, inputs).message;
      return notice;
  }
}

}  // namespace ivo::firmware
