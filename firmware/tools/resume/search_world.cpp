#include "firmware/tools/resume/search_world.hpp"

namespace ivo::firmware {

std::string search_world(const RunOptions& options, RunWorld::Time time) {
  if (options.can.empty()) {
    return "the virtual bus";
  }
  return time == RunWorld::Time::kReal ? options.can : "a simulated interface";
}

std::string other_world(const std::string& kept, const std::string& now) {
  return kept == now ? std::string()
                     : "a search on " + kept + " was cut off here; expected it to be taken up there, not on " + now;
}

}  // namespace ivo::firmware
