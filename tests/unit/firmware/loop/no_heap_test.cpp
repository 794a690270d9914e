// After start-up nothing allocates: every operator new of a cycle is counted, from planning to power-off.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/support/heap_trap.hpp"
#include "tests/support/search_rig.hpp"

namespace {

bool counting = false;
int allocations = 0;

void* allocate(std::size_t size) {
  allocations += counting ? 1 : 0;
  void* const memory = std::malloc(size);
  if (memory == nullptr) {
    std::abort();
  }
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace ivo::firmware {
namespace {

TEST(ControlLoop, NoCycleAllocatesFromPlanningToPowerOff) {
  test::SearchRig rig({});
  counting = true;
  bool started = false;
  bool ended = false;
  {
    const test::NoHeap no_heap;  // malloc too, in the preset noheap
    started = rig.start_search();
    ended = rig.run_until(Mode::kDone);
    rig.run(std::chrono::seconds(1));
  }
  counting = false;
  EXPECT_TRUE(started && ended);
  EXPECT_EQ(allocations, 0);

  counting = true;
  delete new int(1);
  counting = false;
  EXPECT_EQ(allocations, 1) << "the count itself does not work";
}

}  // namespace
}  // namespace ivo::firmware
