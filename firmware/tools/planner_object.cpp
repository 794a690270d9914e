#include "firmware/tools/planner_object.hpp"

#include <cstddef>
#include <new>

#include "hal/linux/huge_pages.hpp"

namespace ivo::firmware {
namespace {

constexpr std::align_val_t kHugePage{std::size_t{2} << 20U};

alignas(planner::Planner) std::byte static_bytes[sizeof(planner::Planner)];

planner::Planner* make_in(void* bytes) {
  hal::prefer_huge_pages(bytes, sizeof(planner::Planner));
  return new (bytes) planner::Planner;
}

}  // namespace

planner::Planner& the_planner() {
  static planner::Planner* const planner = make_in(static_bytes);
  return *planner;
}

void PlannerDeleter::operator()(planner::Planner* planner) const noexcept {
  planner->~Planner();
  ::operator delete(planner, kHugePage);
}

std::unique_ptr<planner::Planner, PlannerDeleter> make_planner() {
  return std::unique_ptr<planner::Planner, PlannerDeleter>(
      make_in(::operator new(sizeof(planner::Planner), kHugePage)));
}

}  // namespace ivo::firmware
