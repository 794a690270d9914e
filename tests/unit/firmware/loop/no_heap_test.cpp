// After start-up nothing allocates: every operator new of a cycle is counted, from planning to power-off.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <optional>

#include "firmware/record/recording_bus.hpp"
#include "tests/support/heap_trap.hpp"
#include "tests/support/search_rig.hpp"

namespace {

bool counting = false;
int allocations = 0;
int* volatile kept = nullptr;  // where a compiler cannot see that it is not used

void* allocate(std::size_t size) {
  allocations += counting ? 1 : 0;
  void* const memory = std::malloc(size);
  if (memory == nullptr) {
    std::abort();
  }
  return memory;
}

}  // namespace

// Not inlined: a compiler that sees into one of a pair and not into the other takes them for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) { return allocate(size); }
[[gnu::noinline]] void* operator new[](std::size_t size) { return allocate(size); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

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
  kept = new int(1);
  delete kept;
  counting = false;
  EXPECT_EQ(allocations, 1) << "the count itself does not work";
}

TEST(ControlLoop, APauseAndAPlanThatIsMadeAnewAllocateNothingEither) {
  test::SearchRig rig({.fault_waits = true, .person = PersonMotion::kReported});
  ASSERT_TRUE(rig.start_search());
  OperatorCommand report(OperatorCommand::kReport);
  report.agent = 1;
  report.place = {9.5, 3.5};
  bool went_on = true;
  const int before = allocations;
  counting = true;
  {
    const test::NoHeap no_heap;
    rig.run(std::chrono::seconds(2));
    rig.loop().request_pause();
    went_on = rig.loop().command(report) && rig.run_until(Mode::kAwaitingConsent, std::chrono::seconds(3));
    went_on = went_on && rig.consent(true) && rig.run_until(Mode::kSearching, std::chrono::seconds(1));
    rig.loop().beat();
    went_on = went_on && rig.run_until(Mode::kAwaitingConsent, std::chrono::seconds(9));  // nobody is there
  }
  counting = false;
  ASSERT_TRUE(went_on);
  ASSERT_TRUE(rig.plan_anew(3)) << "the tables are not made in a cycle";
  counting = true;
  {
    const test::NoHeap no_heap;
    went_on = rig.run_until(Mode::kAwaitingConsent, std::chrono::seconds(30)) && rig.consent() &&
              rig.run_until(Mode::kSearching, std::chrono::seconds(1));
    rig.run(std::chrono::seconds(2));
    OperatorCommand found(OperatorCommand::kFound);
    found.agent = 1;
    went_on = went_on && rig.loop().command(OperatorCommand::kEnough) && rig.loop().command(found) &&
              rig.run_until(Mode::kDone, std::chrono::seconds(3));
  }
  counting = false;
  EXPECT_TRUE(went_on);
  EXPECT_EQ(allocations, before);
}

TEST(ControlLoop, ToRecordItsFramesAllocatesNothingEither) {
  const auto ring = std::make_unique<FrameRing>();
  std::optional<RecordingBus> recording;
  test::SearchRig rig({.between = [&](hal::CanBus& bus) -> hal::CanBus& { return recording.emplace(bus, *ring); }});
  counting = true;
  const int before = allocations;
  const bool started = rig.start_search();
  const int after = allocations;
  counting = false;
  EXPECT_TRUE(started);
  EXPECT_EQ(after, before);
  RecordedFrame frame;
  EXPECT_TRUE(ring->pop(frame));
}

}  // namespace
}  // namespace ivo::firmware
