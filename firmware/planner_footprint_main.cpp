// Run by the build: the bytes of the planner object, by member.
#include <cstdio>

#include "planner/search/planner.hpp"

int main() {
  constexpr double kMegabyte = 1024.0 * 1024.0;
  std::printf("planner, profile %s: %.1f of %.0f MB", ivo::limits::Planner::kName,
              sizeof(ivo::planner::Planner) / kMegabyte, ivo::limits::kPlannerBytes / kMegabyte);
  const char* before = " (";
  for (const ivo::planner::Planner::Part& part : ivo::planner::Planner::parts()) {
    std::printf("%s%s %.1f", before, part.name, static_cast<double>(part.bytes) / kMegabyte);
    before = ", ";
  }
  std::puts(")");
  return 0;
}
