#include "firmware/tools/trace/run_trace.hpp"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <numeric>
#include <utility>

#include "firmware/tools/profile/cycle_profile.hpp"
#include "firmware/tools/profile/profile_text.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""us;
using std::chrono_literals::operator""ms;

const std::string kSource = IVO_SOURCE_DIR;
const std::string kMission =
    "format = 1\nmap = '" + kSource +
    "/config/maps/m1.toml'\nprior = 'uniform'\n[planner]\ncell_m = 0.5\n"
    "[[agent]]\nname = 'IVO'\nkind = 'robot'\nrobot = '" +
    kSource + "/config/robots/ivo.toml'\nstart_m = [1.75, 1.75]\nspeed_mps = 0.4\nsight_radius_m = 2.5\n";

/// Stands at its first event until it may go on.
class SinkThatStandsStill final : public TraceSink {
 public:
  /// Outlives the sink.
  struct Door {
    std::mutex mutex;
    std::condition_variable changed;
    bool standing = false;
    bool open = false;
    std::uint64_t told_lost = 0;
  };
  explicit SinkThatStandsStill(Door& door) : door_(door) {}

  void take(const TraceEvent& /*event*/) override {
    std::unique_lock lock(door_.mutex);
    door_.standing = true;
    door_.changed.notify_all();
    door_.changed.wait(lock, [this] { return door_.open; });
  }
  void write_out() override {}
  [[nodiscard]] Result<void> close(std::uint64_t lost) override {
    door_.told_lost = lost;
    return {};
  }
  [[nodiscard]] std::string summary() const override { return {}; }

 private:
  Door& door_;
};

class RunTraceTest : public testing::Test {
 protected:
  RunTraceTest() {
    Result<MissionInputs> inputs = read_inputs(folder_.put("m.toml", kMission));
    EXPECT_TRUE(inputs.ok());
    inputs_.emplace(std::move(inputs).value());
    options_.speed = 10.0;  // time does not wait for who writes
    Result<std::unique_ptr<RunWorld>> world = RunWorld::open(options_, inputs_->robot);
    EXPECT_TRUE(world.ok());
    world_ = std::move(world).value();
  }
  std::unique_ptr<RunTrace> open() {
    Result<std::unique_ptr<RunTrace>> trace = RunTrace::open(options_, *world_, *inputs_, test::shared_planner());
    EXPECT_TRUE(trace.ok());
    return std::move(trace).value();
  }

  ScratchFolder folder_;
  RunOptions options_;
  std::optional<MissionInputs> inputs_;
  std::unique_ptr<RunWorld> world_;
};

TEST_F(RunTraceTest, WhatASinkThatStandsStillCostsIsCountedAndTold) {
  SinkThatStandsStill::Door door;
  const std::unique_ptr<RunTrace> trace = open();
  auto owned = std::make_unique<CycleProfile>();
  const CycleProfile& profile = *owned;
  trace->add_sink(std::move(owned));
  trace->add_sink(std::make_unique<SinkThatStandsStill>(door));
  trace->start();
  Tracer& tracer = *trace->tracer();
  tracer.mode(0);  // it stands at this one
  {
    std::unique_lock lock(door.mutex);
    door.changed.wait(lock, [&] { return door.standing; });
  }
  tracer.cycle_began(Instant{}, Instant{}, 1us, 0);
  tracer.cycle_ended();
  for (std::size_t i = 2; i < kTracedEvents + 3; ++i) {
    tracer.mode(0);
  }
  EXPECT_EQ(trace->lost(), 3U);
  {
    const std::lock_guard lock(door.mutex);
    door.open = true;
  }
  door.changed.notify_all();
  trace->finish();
  EXPECT_EQ(profile.events, kTracedEvents + 1) << "the ring's, and the one that it stood at";
  const std::string text =
      profile_text({.profile = profile, .period = 2ms, .event_cost_ns = 10.0, .events_lost = trace->lost()});
  EXPECT_NE(text.find("65,537 events, 3 lost;"), std::string::npos) << text;
  EXPECT_TRUE(trace->close().empty());
  EXPECT_EQ(door.told_lost, 3U) << "every file is told at its end";
}

TEST_F(RunTraceTest, TheWayThatWasGoneBeforeIsSearched) {
  planner::Planner& planner = test::shared_planner();
  ASSERT_TRUE(prepare(planner, *inputs_).ok());
  const auto left = [](const BeliefLeft& belief) {
    return std::accumulate(belief.mass().begin(), belief.mass().end(), 0.0);
  };
  const std::vector<Point> path{{1.75, 1.75}, {1.75, 1.75}, {4.75, 1.75}, {4.75, 9.75}};
  BeliefLeft none(planner);
  BeliefLeft begun(planner);
  BeliefLeft further(planner);
  BeliefLeft looked(planner);
  begun.look_along(path, 2.0, 1.5);
  further.look_along(path, 5.0, 1.5);
  looked.look({1.75, 1.75}, 1.5);
  EXPECT_GT(left(none), left(looked));
  EXPECT_GT(left(looked), left(begun));
  EXPECT_GT(left(begun), left(further));
  looked.look({4.75, 3.75}, 1.5);  // 5 m on
  for (std::size_t cell = 0; cell < looked.mass().size(); ++cell) {
    EXPECT_TRUE(looked.mass()[cell] > 0.0F || further.mass()[cell] == 0.0F) << "both ends were looked at";
  }
}

}  // namespace
}  // namespace ivo::firmware
