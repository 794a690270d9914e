// A real interface that goes down, is removed and comes back, under one and the same SocketCanBus.
#include <chrono>
#include <thread>

#include "config/rates.hpp"
#include "hal/linux/interface_watch.hpp"
#include "hal/linux/lock_step.hpp"
#include "tests/unit/hal/vcan_rig.hpp"

namespace ivo::hal {
namespace {

using std::chrono::milliseconds;

constexpr CanFrame kSync{.id = 0x080, .size = 0, .data = {}};
constexpr CanFrame kVelocity{.id = 0x201, .size = 6, .data = {0x0F}};

class Lost : public OnVcan {
 protected:
  void SetUp() override {
    OnVcan::SetUp();
    if (!IsSkipped()) {
      bus_.emplace(SocketCanBus::open(kLink).value());
    }
  }
  SocketCanBus& bus() { return *bus_; }
  std::size_t send(const CanFrame& frame) { return bus().send({&frame, 1}, Instant{}); }

  std::optional<SocketCanBus> bus_;
};

using InterfaceLostTest = Lost;

TEST_F(InterfaceLostTest, DownIsSeenInReceivingAndUpAgainInSending) {
  ASSERT_TRUE(shell("ip link set vcan7 down"));
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kDown);
  EXPECT_EQ(send(kVelocity), 0U);
  EXPECT_EQ(bus().state(), BusState::kDown);
  EXPECT_EQ(bus().counters().send_dropped, 1U) << "nothing waits for an interface that is down";
  ASSERT_TRUE(shell("ip link set vcan7 up"));
  const Stranger stranger(kLink);
  EXPECT_EQ(send(kSync), 1U);
  EXPECT_EQ(bus().state(), BusState::kActive);
  const std::vector<can_frame> heard = stranger.heard();
  ASSERT_EQ(heard.size(), 1U) << "the velocity from before is forgotten";
  EXPECT_EQ(heard[0].can_id, kSync.id);
}

TEST_F(InterfaceLostTest, DownIsSeenInSendingAlone) {
  ASSERT_TRUE(shell("ip link set vcan7 down"));
  EXPECT_EQ(send(kVelocity), 0U);
  EXPECT_EQ(bus().state(), BusState::kDown);
}

TEST_F(InterfaceLostTest, UpAgainIsSeenByALookTooWithoutSending) {
  ASSERT_TRUE(shell("ip link set vcan7 down"));
  bus().look_at_interface();
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kDown);
  ASSERT_TRUE(shell("ip link set vcan7 up"));
  bus().look_at_interface();
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kActive);
}

TEST_F(InterfaceLostTest, ALookFromBeforeDoesNotUndoWhatTheLoopSawItself) {
  bus().look_at_interface();
  ASSERT_TRUE(shell("ip link set vcan7 down"));
  EXPECT_EQ(send(kVelocity), 0U);
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kDown) << "the look saw it up";
  bus().look_at_interface();
  ASSERT_TRUE(shell("ip link set vcan7 up"));
  EXPECT_EQ(send(kSync), 1U);
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kActive) << "the look saw it down";
}

TEST_F(InterfaceLostTest, RemovedAndBackUnderItsNameTheSameBusWorksAgain) {
  remove_link();
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kRemoved);
  EXPECT_EQ(send(kVelocity), 0U);
  bus().look_at_interface();
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kRemoved);

  ASSERT_TRUE(shell("ip link add dev vcan7 type vcan"));
  bus().look_at_interface();
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kRemoved) << "it is there but down, and our socket is the old one's";

  ASSERT_TRUE(shell("ip link set vcan7 up"));
  bus().look_at_interface();
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kActive);
  EXPECT_EQ(bus().details().reopened, 1U);

  const Stranger stranger(kLink);
  EXPECT_EQ(send(kSync), 1U);
  EXPECT_EQ(stranger.heard().size(), 1U) << "SYNC, and no velocity from before";
  ASSERT_TRUE(stranger.put(0x181));
  EXPECT_EQ(ids(bus()), (std::vector<std::uint16_t>{0x181}));
  EXPECT_EQ(bus().counters().confirmed, 1U) << "the new socket hears its own frames too";
}

TEST_F(InterfaceLostTest, ComesBackAsOftenAsItGoesWithTheIdsItHad) {
  const std::array<std::uint16_t, 1> wanted{0x181};
  SocketCanBus few = SocketCanBus::open(kLink, {.ids = wanted}).value();
  for (std::uint64_t round = 1; round <= 3; ++round) {
    remove_link();
    EXPECT_TRUE(receive(few).empty());
    add_link();
    few.look_at_interface();
    const Stranger stranger(kLink);
    ASSERT_TRUE(receive(few).empty());
    ASSERT_TRUE(stranger.put(0x182));
    ASSERT_TRUE(stranger.put(0x181));
    EXPECT_EQ(ids(few), (std::vector<std::uint16_t>{0x181}));
    EXPECT_EQ(few.details().reopened, round);
  }
}

TEST_F(InterfaceLostTest, ReplacedBetweenTwoLooksIsANewInterface) {
  remove_link();
  add_link();
  bus().look_at_interface();
  EXPECT_TRUE(receive(bus()).empty());
  EXPECT_EQ(bus().state(), BusState::kActive);
  EXPECT_EQ(bus().details().reopened, 1U);
}

TEST_F(InterfaceLostTest, AWatchBringsTheBusBackWithoutAWordFromTheLoop) {
  const InterfaceWatch watch(bus());
  remove_link();
  while (bus().state() != BusState::kRemoved) {
    (void)receive(bus());
    std::this_thread::sleep_for(milliseconds(1));
  }
  add_link();
  // A watch that does not see it makes this hang, and the caller's time-out say so.
  while (bus().state() != BusState::kActive) {
    (void)receive(bus());
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_EQ(send(kSync), 1U);
  EXPECT_EQ(bus().details().reopened, 1U);
}

TEST_F(InterfaceLostTest, EndsAWaitInLockStepAtOnceAndComesBackInLockStep) {
  LockStep::Options options;
  ASSERT_TRUE(options.answer_ids.push_back(0x181));
  options.patience = std::chrono::minutes(5);  // a test that waits in vain hangs
  LockStep step(bus(), options);
  std::array<ReceivedFrame, 8> frames;
  Instant now{};
  const auto cycle = [&] {
    const std::size_t taken = step.send({&kSync, 1}, now);
    now += milliseconds(2);
    step.sleep_until(now);
    (void)step.receive(frames, now);
    return taken;
  };
  std::thread remover([] {
    std::this_thread::sleep_for(milliseconds(50));
    remove_link();
  });
  EXPECT_EQ(cycle(), 1U);
  remover.join();
  EXPECT_TRUE(lost(step.state())) << "it is down before it is gone";
  EXPECT_FALSE(step.stalled());
  EXPECT_EQ(cycle(), 0U);
  EXPECT_EQ(step.state(), BusState::kRemoved);
  add_link();
  EXPECT_EQ(cycle(), 0U) << "this sleep sees it";
  const Stranger drive(kLink);
  ASSERT_TRUE(drive.put(0x181));
  EXPECT_EQ(cycle(), 0U) << "and this one takes the new socket";
  EXPECT_EQ(step.state(), BusState::kActive);
  ASSERT_TRUE(drive.put(0x181));
  EXPECT_EQ(cycle(), 1U);
  EXPECT_FALSE(step.stalled());
}

}  // namespace
}  // namespace ivo::hal
