#include "firmware/web/ros/ros_session.hpp"

namespace ivo::firmware::web {

void RosSession::hear(std::string_view /*message*/, bool /*binary*/, Instant /*now*/) {}
void RosSession::answered(std::uint32_t /*ask*/, Verdict /*verdict*/) {}
std::vector<Frame> RosSession::take(Instant /*now*/) { return {}; }

}  // namespace ivo::firmware::web
