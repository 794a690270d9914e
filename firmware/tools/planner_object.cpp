#include "firmware/tools/planner_object.hpp"

namespace ivo::firmware {

planner::Planner& the_planner() {
  static planner::Planner planner;
  return planner;
}

}  // namespace ivo::firmware
