#include "hal/linux/lock_step.hpp"

#include <gtest/gtest.h>
#include <linux/can/error.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <csignal>
#include <thread>
#include <vector>

namespace ivo::hal {
namespace {

using std::chrono::milliseconds;

constexpr CanFrame frame_of(std::uint16_t id) { return {.id = id, .size = 0, .data = {}}; }
constexpr CanFrame kSyncFrame = frame_of(0x080);

/// A lock step whose other end the test plays.
class LockStepWithPeer : public testing::Test {
 protected:
  static LockStep::Options options(Duration patience) {
    LockStep::Options options;
    for (const std::uint16_t id : std::initializer_list<std::uint16_t>{0x181, 0x182, 0x183, 0x184}) {
      EXPECT_TRUE(options.answer_ids.push_back(id));
    }
    options.patience = patience;
    return options;
  }
  void answer(std::initializer_list<std::uint16_t> ids) {
    for (const std::uint16_t id : ids) {
      const CanFrame frame = frame_of(id);
      ASSERT_EQ(peer_.send({&frame, 1}, Instant{}), 1U);
    }
  }
  std::vector<std::uint16_t> received(LockStep& step) {
    std::array<ReceivedFrame, 64> frames;
    const std::size_t count = step.receive(frames, Instant{});
    std::vector<std::uint16_t> ids;
    for (std::size_t i = 0; i < count; ++i) {
      ids.push_back(frames[i].frame.id);
    }
    return ids;
  }

  std::array<int, 2> fds_ = [] {
    std::array<int, 2> fds{};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, fds.data()), 0);
    return fds;
  }();
  SocketCanBus bus_{FileDescriptor(fds_[0])};
  SocketCanBus peer_{FileDescriptor(fds_[1])};
  // Long enough that a test which waits in vain is a test that fails by hanging, not one that passes by luck.
  LockStep step_{bus_, options(std::chrono::minutes(5))};
  LockStep impatient_{bus_, options(milliseconds(5))};
  Instant next_{milliseconds(2)};
};

using LockStepTest = LockStepWithPeer;

TEST_F(LockStepTest, DoesNotWaitBeforeAnythingWasSent) {
  step_.expect_answers(4);
  step_.sleep_until(next_);
  EXPECT_EQ(step_.now(), next_);
  EXPECT_FALSE(step_.stalled());
}

TEST_F(LockStepTest, DoesNotWaitWhenNothingIsExpected) {
  const CanFrame heartbeat = frame_of(0x77F);
  step_.send({&heartbeat, 1}, Instant{});
  step_.sleep_until(next_);
  EXPECT_EQ(step_.now(), next_);
}

TEST_F(LockStepTest, AfterSyncWaitsForEveryFeedbackWhateverElseArrives) {
  step_.send({&kSyncFrame, 1}, Instant{});
  answer({0x181, 0x182});
  std::thread drives([this] { answer({0x701, 0x581, 0x184, 0x182, 0x183}); });
  step_.sleep_until(next_);
  drives.join();
  EXPECT_EQ(step_.now(), next_);
  EXPECT_EQ(received(step_), (std::vector<std::uint16_t>{0x181, 0x182, 0x701, 0x581, 0x184, 0x182, 0x183}));
}

TEST_F(LockStepTest, ADriveMayTurnOutToAnswerWithAnotherTpdo) {
  impatient_.answer_with(1, 0x382);
  impatient_.send({&kSyncFrame, 1}, Instant{});
  answer({0x181, 0x382, 0x183, 0x184});
  impatient_.sleep_until(next_);
  EXPECT_FALSE(impatient_.stalled());
  impatient_.send({&kSyncFrame, 1}, Instant{});
  answer({0x181, 0x182, 0x183, 0x184});
  impatient_.sleep_until(next_ + milliseconds(2));
  EXPECT_TRUE(impatient_.stalled()) << "the TPDO1 of that drive is sent for another reason";
}

TEST_F(LockStepTest, AfterSyncOneFeedbackMissingStallsAndIsNotMadeUpForByAnother) {
  impatient_.send({&kSyncFrame, 1}, Instant{});
  answer({0x181, 0x182, 0x183, 0x183, 0x183});
  impatient_.sleep_until(next_);
  EXPECT_TRUE(impatient_.stalled());
}

TEST_F(LockStepTest, OutsideOfSyncWaitsForAsManyAnswersAsAreExpected) {
  const CanFrame request = frame_of(0x601);
  step_.send({&request, 1}, Instant{});
  step_.expect_answers(2);
  answer({0x581});
  std::thread drives([this] { answer({0x582}); });
  step_.sleep_until(next_);
  drives.join();
  EXPECT_EQ(received(step_).size(), 2U);
}

TEST_F(LockStepTest, HoldsBackWhatArrivesAfterTheSleep) {
  step_.send({&kSyncFrame, 1}, Instant{});
  answer({0x181, 0x182, 0x183, 0x184});
  step_.sleep_until(next_);
  answer({0x701});
  EXPECT_EQ(received(step_).size(), 4U);
  EXPECT_TRUE(received(step_).empty());
  step_.sleep_until(next_ + milliseconds(2));
  EXPECT_EQ(received(step_), (std::vector<std::uint16_t>{0x701}));
}

TEST_F(LockStepTest, StallsWhenDrivesStaySilentAndNeverWaitsAgain) {
  impatient_.send({&kSyncFrame, 1}, Instant{});
  impatient_.sleep_until(next_);
  EXPECT_TRUE(impatient_.stalled());
  EXPECT_EQ(impatient_.now(), next_);
  impatient_.send({&kSyncFrame, 1}, Instant{});
  impatient_.sleep_until(next_ + milliseconds(2));
  EXPECT_EQ(impatient_.now(), next_ + milliseconds(2));
}

TEST_F(LockStepTest, ASyncThatTheInterfaceRefusedIsNotWaitedFor) {
  while (bus_.send({&kSyncFrame, 1}, Instant{}) == 1) {
  }
  const std::array<CanFrame, 2> frames{kSyncFrame, kSyncFrame};
  EXPECT_EQ(step_.send(frames, Instant{}), 0U);
  step_.sleep_until(next_);
  EXPECT_FALSE(step_.stalled());
}

TEST_F(LockStepTest, CountsFramesThatItsQueueCannotHold) {
  const CanFrame noise = frame_of(0x7FF);
  const std::vector<CanFrame> burst(64, noise);
  for (std::size_t sent = 0; sent < LockStep::kQueueFrames + 64; sent += burst.size()) {
    ASSERT_EQ(peer_.send(burst, Instant{}), burst.size());
    step_.sleep_until(next_);
  }
  EXPECT_EQ(step_.counters().receive_dropped, 64U);
  EXPECT_EQ(step_.counters().received, LockStep::kQueueFrames);
}

TEST_F(LockStepTest, GoesOnWithoutWaitingWhileTheBusIsOff) {
  step_.send({&kSyncFrame, 1}, Instant{});
  can_frame off{};
  off.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
  off.can_dlc = CAN_ERR_DLC;
  std::thread peer([&] { ASSERT_GT(write(fds_[1], &off, sizeof off), 0); });
  step_.sleep_until(next_);
  peer.join();
  EXPECT_EQ(step_.now(), next_);
  EXPECT_FALSE(step_.stalled());
  EXPECT_EQ(step_.state(), BusState::kOff);
}

TEST_F(LockStepTest, ASyncThatGoesOutLaterIsWaitedForThen) {
  while (bus_.send({&kSyncFrame, 1}, Instant{}) == 1) {
  }
  impatient_.sleep_until(next_);
  EXPECT_FALSE(impatient_.stalled());
  std::array<ReceivedFrame, 64> frames;
  while (peer_.receive(frames, Instant{}) > 0) {
  }
  EXPECT_EQ(impatient_.send({}, next_), 0U);
  impatient_.sleep_until(next_ + milliseconds(2));
  EXPECT_TRUE(impatient_.stalled()) << "the SYNC that was left over is out, and nobody answers";
}

TEST_F(LockStepTest, SomebodyInAHurryEndsAWaitForSilentDrives) {
  step_.send({&kSyncFrame, 1}, Instant{});
  step_.interrupt();
  step_.sleep_until(next_);
  EXPECT_TRUE(step_.stalled()) << "after a second, not after five minutes";
}

TEST_F(LockStepTest, SomebodyInAHurryDoesNotEndAWaitThatDrivesAnswer) {
  step_.send({&kSyncFrame, 1}, Instant{});
  step_.interrupt();
  answer({0x181, 0x182, 0x183, 0x184});
  step_.sleep_until(next_);
  EXPECT_FALSE(step_.stalled());
}

TEST_F(LockStepTest, ASignalDuringAWaitIsAHurry) {
  struct sigaction nothing {};
  nothing.sa_handler = [](int) {};
  ASSERT_EQ(sigaction(SIGUSR1, &nothing, nullptr), 0);
  step_.send({&kSyncFrame, 1}, Instant{});
  std::atomic<bool> over{false};
  const pthread_t waiting = pthread_self();
  std::thread person([&] {
    while (!over.load()) {
      pthread_kill(waiting, SIGUSR1);
      std::this_thread::sleep_for(milliseconds(20));
    }
  });
  step_.sleep_until(next_);
  over.store(true);
  person.join();
  EXPECT_TRUE(step_.stalled());
}

}  // namespace
}  // namespace ivo::hal
