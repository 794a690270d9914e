// What a screen or a ROS client asks for, once its form has been judged. Whether it may, and whether that can be done
// now, is looked at later.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "config/base/geometry.hpp"
#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::web {

/// `seen`: the number of the newest status that its screen has drawn; 0 of what has no screen.
struct Beat {
  std::uint32_t seen = 0;
};
struct Stop {};  ///< the robot stands until consent anew
struct End {};   ///< the run ends
struct Init {};
struct Replan {
  std::uint32_t areas_revision = 0;
};
struct Enough {
  std::uint32_t plan = 0;
};
struct Accept {
  std::uint32_t plan = 0;
};
struct Start {
  std::uint32_t question = 0;
  std::uint32_t seen = 0;  ///< as of a Beat
};
struct ClearFault {
  std::uint32_t question = 0;
};
struct Found {
  std::uint8_t agent = 0;
};
/// Where an agent is: a person by a tap, any by a tracker.
struct Position {
  std::uint8_t agent = 0;
  Pose pose;
  double sigma_m = 0.0;
  double sigma_heading_rad = 0.0;
  double age_s = 0.0;  ///< 0 to 10
};
struct PutArea {
  std::uint8_t slot = 0;
  console::AreaPurpose purpose{};
  std::uint8_t agent = 0;      ///< index, or console::AreaCommand::kEverybody
  std::vector<Point> polygon;  ///< 3 to console::kAreaCorners
};
struct RemoveArea {
  std::uint8_t slot = 0;
};
struct RequestControl {};
struct GiveControl {};
struct KeepControl {};
struct ReleaseControl {};

using Request = std::variant<Beat, Stop, End, Init, Replan, Enough, Accept, Start, ClearFault, Found, Position, PutArea,
                             RemoveArea, RequestControl, GiveControl, KeepControl, ReleaseControl>;

}  // namespace ivo::firmware::web
