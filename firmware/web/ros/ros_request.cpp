#include "firmware/web/ros/ros_request.hpp"

namespace ivo::firmware::web {
namespace {

std::uint8_t likely_finder(const RosMission& mission) {
  for (std::size_t i = 0; i < mission.agents.size(); ++i) {
    if (mission.agents[i].person) {
      return static_cast<std::uint8_t>(i);
    }
  }
  return 0;
}

Result<Request> start_of(const console::Status& status, std::uint32_t accepted_plan) {
  if (status.accepted == 0 && (accepted_plan == 0 || accepted_plan != status.plan_number)) {
    return Error{"the plan is not accepted; expected /ivo/accept first"};
  }
  if (status.asks != console::Asks::kConsent) {
    return Error{"nobody asks for consent now; expected a robot that stands with a plan"};
  }
  return Request(Start{status.question});
}

}  // namespace

Result<Request> ros_request(RosAsk what, std::optional<std::size_t> agent, const View& view, const RosMission& mission,
                            std::uint32_t accepted_plan) {
  switch (what) {
    case RosAsk::kInit:
      return Request(Init{});
    case RosAsk::kStop:
      return Request(Stop{});
    case RosAsk::kEnd:
      return Request(End{});
    case RosAsk::kTakeControl:
      return Request(RequestControl{});
    case RosAsk::kReleaseControl:
      return Request(ReleaseControl{});
    case RosAsk::kGiveControl:
      return Request(GiveControl{});
    case RosAsk::kKeepControl:
      return Request(KeepControl{});
    case RosAsk::kFound:
      return Request(Found{agent ? static_cast<std::uint8_t>(*agent) : likely_finder(mission)});
    case RosAsk::kReplan:
    case RosAsk::kEnough:
    case RosAsk::kAccept:
    case RosAsk::kStart:
    case RosAsk::kClearFault:
      break;
  }
  if (!view.status) {
    return Error{"the controller was never there; expected one that shows a plan"};
  }
  const console::Status& status = *view.status;
  switch (what) {
    case RosAsk::kReplan:
      return Request(Replan{status.areas_revision});
    case RosAsk::kEnough:
      return Request(Enough{status.plan_number});
    case RosAsk::kAccept:
      return Request(Accept{status.plan_number});
    case RosAsk::kClearFault:
      return Request(ClearFault{status.question});
    default:
      return start_of(status, accepted_plan);
  }
}

}  // namespace ivo::firmware::web
