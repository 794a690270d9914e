#include "firmware/tools/colonies.hpp"

#include <string>

namespace ivo::firmware {
namespace {

constexpr planner::Budget kPart{200'000};

}  // namespace

Result<Colonies> Colonies::create(planner::Planner& planner, int count) {
  if (count < 1 || count > kMost) {
    return Error{"--threads: " + std::to_string(count) + "; expected 1" +
                 (kMost > 1 ? " to " + std::to_string(kMost) : std::string())};
  }
  return Colonies(planner);
}

planner::Progress Colonies::search_on() { return planner_->step(kPart); }

}  // namespace ivo::firmware
