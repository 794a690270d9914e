// Every fault that a script can switch on does what its name says, and goes when it is switched off.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <vector>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/canopen/sync.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/sim/sim_change_text.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "drivers/sim/sim_fault_text.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;
using std::chrono::milliseconds;

constexpr Duration kCycle = milliseconds(2);
constexpr std::int32_t kSpeed = 1000;

/// One drive, node 3, mapped as the product maps it, asked and moved by hand.
class FaultyDrive : public testing::Test {
 protected:
  FaultyDrive() {
    drive_.open(out_);
    write(object::kConsumerHeartbeat, 4, 127U << 16 | 60'000U);
    write(object::kProducerHeartbeat, 2, 50);
    write(object::kCyclePeriod, 4, 2000);
    write(object::kAbortConnectionOption, 2, 3);
    for (const auto& [cob_id, count, first, second] : {std::tuple{0x1400U, 0x1600U, 0x60400010U, 0x60FF0020U},
                                                       std::tuple{0x1800U, 0x1A00U, 0x60410010U, 0x60640020U}}) {
      const auto communication = static_cast<std::uint16_t>(cob_id);
      const auto mapping = static_cast<std::uint16_t>(count);
      const std::uint32_t id = cob_id == 0x1400 ? 0x203 : 0x183;
      write({communication, 1}, 4, id | 0x80000000U);
      write({mapping, 0}, 1, 0);
      write({mapping, 1}, 4, first);
      write({mapping, 2}, 4, second);
      write({mapping, 0}, 1, 2);
      write({communication, 2}, 1, 1);
      write({communication, 1}, 4, id);
    }
    write(object::kModeOfOperation, 1, 9);
    hear(nmt_frame({NmtCommand::kStart, 3}));
  }

  void hear(const hal::CanFrame& frame) {
    drive_.on_frame(frame, out_);
    keep();
  }
  void keep() {
    sent_.insert(sent_.end(), out_.begin(), out_.end());
    out_.clear();
  }
  SdoMessage ask(const SdoMessage& request) {
    sent_.clear();
    hear(sdo_frame(0x603, request));
    return sent_.empty() ? SdoMessage{} : parse_sdo(sent_.back()).value_or(SdoMessage{});
  }
  SdoMessage read(ObjectAddress object) { return ask({0x40, object, 0}); }
  void write(ObjectAddress object, std::uint8_t bytes, std::uint32_t value) {
    EXPECT_EQ(ask({sdo_command::expedited(0x20, bytes), object, value}).command, 0x60) << object.index;
  }

  /// So many SYNCs; time, command, SYNC. `frames` of the last cycle are in sent_.
  void cycle(int times = 1) {
    for (; times > 0; --times) {
      sent_.clear();
      now_ += kCycle;
      drive_.advance_to(now_, out_);
      keep();
      hal::CanFrame command{.id = 0x203, .size = 6, .data = {}};
      store(std::span(command.data), word_);
      store(std::span(command.data).subspan(2), static_cast<std::uint32_t>(target_));
      hear(command);
      hear(sync_frame());
      history_.insert(history_.end(), sent_.begin(), sent_.end());
    }
  }
  void enable(std::int32_t target = kSpeed) {
    for (const std::uint16_t word : std::array<std::uint16_t, 3>{0x06, 0x07, 0x0F}) {
      word_ = word;
      cycle(2);
    }
    target_ = target;
    cycle(300);
    ASSERT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
    history_.clear();
  }
  void set(SimFault fault, std::uint32_t value = 0, ObjectAddress object = {}) {
    ASSERT_TRUE(drive_.script().events.push_back({.at = now_, .fault = fault, .value = value, .object = object}));
  }
  void clear(SimFault fault) {
    ASSERT_TRUE(drive_.script().events.push_back({.at = now_, .fault = fault, .on = false}));
  }
  void apply() {
    drive_.advance_to(now_, out_);
    keep();
  }

  [[nodiscard]] std::vector<hal::CanFrame> of(std::uint16_t id, const std::vector<hal::CanFrame>& frames) const {
    std::vector<hal::CanFrame> found;
    std::copy_if(frames.begin(), frames.end(), std::back_inserter(found),
                 [id](const hal::CanFrame& frame) { return frame.id == id; });
    return found;
  }
  [[nodiscard]] std::vector<hal::CanFrame> tpdos() const { return of(0x183, sent_); }

  SimDrive drive_{DriveParameters{.node_id = 3}};
  SimDrive::Outbox out_;
  std::vector<hal::CanFrame> sent_;
  std::vector<hal::CanFrame> history_;
  Instant now_{};
  std::uint16_t word_ = 0;
  std::int32_t target_ = 0;
};

std::int32_t position(const hal::CanFrame& tpdo) {
  return static_cast<std::int32_t>(load<std::uint32_t>(std::span<const std::uint8_t>(tpdo.data).subspan(2)));
}

TEST_F(FaultyDrive, WithoutFaultsAnswersEachSyncOnce) {
  enable();
  for (int i = 0; i < 100; ++i) {
    cycle();
    ASSERT_EQ(tpdos().size(), 1U);
    EXPECT_EQ(tpdos()[0].size, 6);
  }
  EXPECT_GE(of(0x703, history_).size(), 3U);
  EXPECT_TRUE(of(0x083, history_).empty());
}

TEST_F(FaultyDrive, SilentSaysNothingUntilItIsOver) {
  enable();
  set(SimFault::kSilent);
  cycle(100);
  EXPECT_TRUE(history_.empty());
  EXPECT_FALSE(drive_.motion().at_rest()) << "it still turns";
  clear(SimFault::kSilent);
  cycle();
  EXPECT_EQ(tpdos().size(), 1U);
}

TEST_F(FaultyDrive, NoHeartbeatAndNoTpdoAreApart) {
  enable();
  set(SimFault::kNoHeartbeat);
  cycle(100);
  EXPECT_EQ(of(0x703, history_).size(), 0U);
  EXPECT_EQ(of(0x183, history_).size(), 100U);
  clear(SimFault::kNoHeartbeat);
  set(SimFault::kNoTpdo);
  history_.clear();
  cycle(100);
  EXPECT_GE(of(0x703, history_).size(), 3U);
  EXPECT_EQ(of(0x183, history_).size(), 0U);
}

TEST_F(FaultyDrive, LateTpdosAreThoseOfTheSyncBefore) {
  enable();
  cycle();
  const std::int32_t step = position(tpdos()[0]);
  set(SimFault::kLateTpdo);
  cycle();
  EXPECT_TRUE(tpdos().empty());
  cycle();
  ASSERT_EQ(tpdos().size(), 1U);
  EXPECT_EQ(position(tpdos()[0]) - step, kSpeed * 2 / 1000);
  clear(SimFault::kLateTpdo);
  cycle();
  EXPECT_EQ(tpdos().size(), 2U) << "the one that was held comes too";
  cycle();
  EXPECT_EQ(tpdos().size(), 1U);
}

TEST_F(FaultyDrive, DuplicateTpdosComeTwice) {
  enable();
  set(SimFault::kDuplicateTpdo);
  cycle();
  ASSERT_EQ(tpdos().size(), 2U);
  EXPECT_EQ(tpdos()[0], tpdos()[1]);
}

TEST_F(FaultyDrive, ReorderedTpdosComeInPairsTheNewerFirst) {
  enable();
  set(SimFault::kReorderedTpdo);
  cycle();
  EXPECT_TRUE(tpdos().empty());
  cycle();
  ASSERT_EQ(tpdos().size(), 2U);
  EXPECT_GT(position(tpdos()[0]), position(tpdos()[1]));
}

TEST_F(FaultyDrive, StuckAndShortTpdos) {
  enable();
  cycle();
  const hal::CanFrame last = tpdos()[0];
  set(SimFault::kStuckTpdo);
  for (int i = 0; i < 10; ++i) {
    cycle();
    EXPECT_EQ(tpdos()[0], last);
  }
  EXPECT_GT(drive_.motion().position(), position(last));
  clear(SimFault::kStuckTpdo);
  set(SimFault::kShortTpdo, 3);
  cycle();
  EXPECT_EQ(tpdos()[0].size, 3);
}

TEST_F(FaultyDrive, SyncOfItsOwnAndSomebodyWhoThinksHeIsMaster) {
  cycle();
  set(SimFault::kSyncProducer, 4000);
  set(SimFault::kForeignMaster);
  set(SimFault::kForeignNmt, 0x0203);
  set(SimFault::kForeignClient);
  history_.clear();
  cycle(100);
  EXPECT_EQ(of(0x080, history_).size(), 50U);
  EXPECT_EQ(of(0x77F, history_).size(), 4U) << "as node 127, whom it watches";
  EXPECT_EQ(of(0x603, history_).size(), 4U);
  EXPECT_EQ(of(0x583, history_).size(), 4U) << "and answers him";
  ASSERT_EQ(of(0x000, history_).size(), 1U);
  EXPECT_EQ(of(0x000, history_)[0], nmt_frame({NmtCommand::kStop, 3}));
}

TEST_F(FaultyDrive, ADuplicateNodeBootsBeatsAndAnswersToo) {
  cycle();
  set(SimFault::kDuplicateNode);
  history_.clear();
  cycle(100);
  const std::vector<hal::CanFrame> beats = of(0x703, history_);
  EXPECT_EQ(std::count(beats.begin(), beats.end(), heartbeat_frame(3, NmtState::kBootUp)), 1);
  EXPECT_GE(std::count(beats.begin(), beats.end(), heartbeat_frame(3, NmtState::kPreOperational)), 3);
  EXPECT_GE(std::count(beats.begin(), beats.end(), heartbeat_frame(3, NmtState::kOperational)), 3);
  (void)read(object::kDeviceType);
  EXPECT_EQ(of(0x583, sent_).size(), 2U);
}

TEST_F(FaultyDrive, AnEmergencyStormIsOneAMillisecondAndEmcyInhibitTimeTamesIt) {
  cycle();
  set(SimFault::kEmergencyStorm, 0x4210);
  history_.clear();
  cycle(50);
  EXPECT_NEAR(static_cast<double>(of(0x083, history_).size()), 100.0, 2.0);
  EXPECT_EQ(of(0x083, history_)[0].data[1], 0x42);
  write({0x1015, 0}, 2, 100);  // 10 ms
  history_.clear();
  cycle(50);
  EXPECT_LE(of(0x083, history_).size(), 11U);
}

TEST_F(FaultyDrive, TellsOfAnErrorOnceAndOfItsEndOnce) {
  cycle();
  history_.clear();
  for (int i = 0; i < 5; ++i) {
    hear({.id = 0x203, .size = 4, .data = {0x06}});
    hear(sync_frame());
  }
  std::vector<hal::CanFrame> emergencies = of(0x083, sent_);
  ASSERT_EQ(emergencies.size(), 1U);
  EXPECT_EQ(load<std::uint16_t>(emergencies[0].data), 0x8210);
  EXPECT_EQ(emergencies[0].data[2], 0x11) << "generic and communication";
  cycle(2);
  emergencies = of(0x083, history_);
  ASSERT_EQ(emergencies.size(), 1U);
  EXPECT_EQ(load<std::uint16_t>(emergencies[0].data), 0);
  EXPECT_EQ(emergencies[0].data[2], 0);
}

TEST_F(FaultyDrive, SaysThatItsMasterIsBackOnlyWhenNothingElseIsWrong) {
  write(object::kConsumerHeartbeat, 4, 127U << 16 | 10U);
  write({0x1029, 1}, 1, 1);
  const hal::CanFrame beat = heartbeat_frame(127, NmtState::kOperational);
  hear(beat);
  cycle(6);
  set(SimFault::kFault, 0x3210);
  history_.clear();
  cycle(2);
  hear(beat);
  cycle(2);
  EXPECT_EQ(of(0x083, history_).size(), 1U) << "the drive's own fault; the other is gone, but not all are";
  EXPECT_EQ(read(object::kErrorRegister).data, 0x05U);
  word_ = 0;
  cycle(2);
  hear(beat);
  word_ = cia402::controlword::kFaultReset;
  history_.clear();
  cycle(2);
  ASSERT_EQ(of(0x083, history_).size(), 1U);
  EXPECT_EQ(load<std::uint16_t>(of(0x083, history_)[0].data), 0);
}

TEST_F(FaultyDrive, ARebootTakesAsLongAsItSays) {
  enable();
  set(SimFault::kReboot, 50);
  cycle(20);
  EXPECT_TRUE(history_.empty());
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  cycle(10);
  ASSERT_EQ(history_.size(), 1U);
  EXPECT_EQ(history_[0], heartbeat_frame(3, NmtState::kBootUp));
  EXPECT_EQ(drive_.nmt_state(), NmtState::kPreOperational);
  EXPECT_EQ(read(object::kModeOfOperation).data, 0U) << "what it was told is forgotten";
}

TEST_F(FaultyDrive, LeavesOperationalByItself) {
  enable();
  set(SimFault::kLeaveOperational);
  cycle();
  EXPECT_EQ(drive_.nmt_state(), NmtState::kPreOperational);
  EXPECT_NE(drive_.power_state(), PowerState::kOperationEnabled);
}

TEST_F(FaultyDrive, AFaultComesOnceAndFaultAgainAfterEachReset) {
  enable();
  set(SimFault::kFault, 0x3210);
  cycle(200);
  EXPECT_EQ(drive_.power_state(), PowerState::kFault);
  EXPECT_TRUE(drive_.motion().at_rest());
  const auto emergencies = of(0x083, history_);
  ASSERT_EQ(emergencies.size(), 1U);
  EXPECT_EQ(load<std::uint16_t>(emergencies[0].data), 0x3210);
  EXPECT_EQ(emergencies[0].data[2], 0x05) << "generic and voltage";
  EXPECT_EQ(emergencies[0].data[7], 3) << "vendor bytes say who";
  word_ = cia402::controlword::kFaultReset;
  cycle(3);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  set(SimFault::kFaultAgain, 0x4310);
  cycle(3);
  EXPECT_EQ(drive_.power_state(), PowerState::kFault);
  for (int resets = 0; resets < 3; ++resets) {
    word_ = 0;
    cycle(2);
    word_ = cia402::controlword::kFaultReset;
    history_.clear();
    cycle(4);
    EXPECT_EQ(drive_.power_state(), PowerState::kFault);
    EXPECT_EQ(of(0x083, history_).size(), 2U) << "gone, and again";
  }
}

TEST_F(FaultyDrive, AnOpenStoTakesThePowerAndGivesNoneBackByItself) {
  enable();
  set(SimFault::kStoOpen);
  cycle(2);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(tpdos()[0].data[0] & 0x10, 0) << "no voltage";
  for (const std::uint16_t word : std::array<std::uint16_t, 3>{0x06, 0x07, 0x0F}) {
    word_ = word;
    cycle(5);
    EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  }
  clear(SimFault::kStoOpen);
  cycle(5);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled) << "0Fh alone does not enable";
  EXPECT_NE(tpdos()[0].data[0] & 0x10, 0);
  word_ = 0x06;
  cycle(2);
  EXPECT_EQ(drive_.power_state(), PowerState::kReadyToSwitchOn);
}

TEST_F(FaultyDrive, RefusesTheModeAndTheEnabling) {
  set(SimFault::kModeRefused);
  cycle();
  write(object::kModeOfOperation, 1, 3);
  EXPECT_EQ(read(object::kModeDisplay).data, 0U);
  clear(SimFault::kModeRefused);
  cycle();
  write(object::kModeOfOperation, 1, 9);
  enable();
  set(SimFault::kNotEnabling);
  cycle(2);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchedOn) << "0Fh all the time";
  clear(SimFault::kNotEnabling);
  cycle(2);
  EXPECT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
}

TEST_F(FaultyDrive, AnEndlessQuickStopDoesNotStop) {
  enable();
  set(SimFault::kEndlessStop);
  word_ = cia402::controlword::kQuickStop;
  cycle(1000);
  EXPECT_EQ(drive_.power_state(), PowerState::kQuickStopActive);
  EXPECT_EQ(drive_.motion().velocity(), kSpeed);
  clear(SimFault::kEndlessStop);
  cycle(100);
  EXPECT_TRUE(drive_.motion().at_rest());
}

TEST_F(FaultyDrive, ASlippingRimGoesLessFarThanTheMotor) {
  enable();
  const std::int64_t counts = drive_.motion().position();
  const std::int64_t rim = drive_.motion().rim_counts();
  set(SimFault::kSlip, 250);
  cycle(500);
  const auto turned = static_cast<double>(drive_.motion().position() - counts);
  EXPECT_NEAR(turned, kSpeed, 3);
  EXPECT_NEAR(static_cast<double>(drive_.motion().rim_counts() - rim), 0.75 * turned, 3);
}

TEST_F(FaultyDrive, AStuckEncoderShowsNothingOfAWheelThatTurns) {
  enable();
  cycle();
  const std::int32_t before = position(tpdos()[0]);
  set(SimFault::kEncoderStuck);
  cycle(100);
  constexpr std::int32_t kOneCycle = kSpeed * 2 / 1000;
  EXPECT_LE(position(tpdos()[0]) - before, kOneCycle);
  EXPECT_EQ(read(object::kVelocityActual).data, 0U);
  EXPECT_EQ(drive_.motion().velocity(), kSpeed);
}

TEST_F(FaultyDrive, ABlockedWheelStands) {
  enable();
  set(SimFault::kBlocked);
  cycle(3);
  EXPECT_TRUE(drive_.motion().at_rest());
  EXPECT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
  clear(SimFault::kBlocked);
  cycle(300);
  EXPECT_EQ(drive_.motion().velocity(), kSpeed);
}

TEST_F(FaultyDrive, SdoAnswersInEveryWrongWay) {
  set(SimFault::kSdoAbort, 0x06060000, object::kModeDisplay);
  apply();
  EXPECT_EQ(read(object::kModeDisplay).data, 0x06060000U);
  EXPECT_EQ(read(object::kDeviceType).command, 0x43);
  set(SimFault::kSdoAbort, 0x08000000);
  apply();
  EXPECT_EQ(read(object::kDeviceType).command, 0x80);
  clear(SimFault::kSdoAbort);

  set(SimFault::kSdoWrongIndex);
  apply();
  EXPECT_EQ(read(object::kDeviceType).address.index, 0x1001);
  clear(SimFault::kSdoWrongIndex);

  set(SimFault::kSdoNoSize);
  apply();
  EXPECT_EQ(read(object::kModeDisplay).command, 0x42);
  clear(SimFault::kSdoNoSize);

  set(SimFault::kSdoSegmented);
  apply();
  EXPECT_EQ(read(object::kDeviceType).command, 0x41);
  EXPECT_EQ(read(object::kDeviceType).data, 4U);
  hear({.id = 0x603, .size = 8, .data = {0x60}});
  EXPECT_EQ(sent_.back().data[0], 0x07) << "four bytes, the last segment, toggle 0";
  set(SimFault::kSdoToggle);
  apply();
  (void)read(object::kDeviceType);
  hear({.id = 0x603, .size = 8, .data = {0x60}});
  EXPECT_EQ(sent_.back().data[0], 0x17) << "toggle 1";
  clear(SimFault::kSdoToggle);
  clear(SimFault::kSdoSegmented);

  set(SimFault::kSdoSilent);
  apply();
  (void)read(object::kDeviceType);
  EXPECT_TRUE(sent_.empty());
  clear(SimFault::kSdoSilent);

  set(SimFault::kOtherIdentity, 0x1234);
  apply();
  EXPECT_EQ(read(object::kVendorId).data, 0x1234U);
}

TEST_F(FaultyDrive, SlowSdoAnswersComeLate) {
  set(SimFault::kSlowSdo, 20);
  apply();
  (void)read(object::kDeviceType);
  EXPECT_TRUE(of(0x583, sent_).empty());
  cycle(9);
  EXPECT_TRUE(of(0x583, history_).empty());
  cycle(1);
  ASSERT_EQ(of(0x583, history_).size(), 1U);
  EXPECT_EQ(of(0x583, history_)[0].data[0], 0x43);
}

TEST_F(FaultyDrive, EventsHappenAtTheirTimeAndInTheirOrder) {
  SimDrive drive(DriveParameters{.node_id = 3});
  auto& events = drive.script().events;
  ASSERT_TRUE(events.push_back({.at = Instant(milliseconds(10)), .fault = SimFault::kSilent}));
  ASSERT_TRUE(events.push_back({.at = Instant(milliseconds(20)), .fault = SimFault::kSilent, .on = false}));
  drive.open(out_);
  std::vector<int> answers;
  for (int ms = 0; ms < 30; ++ms) {
    out_.clear();
    drive.advance_to(Instant(milliseconds(ms)), out_);
    drive.on_frame(sdo_frame(0x603, {0x40, object::kDeviceType, 0}), out_);
    answers.push_back(static_cast<int>(out_.size()));
  }
  std::vector<int> expected(30, 1);
  std::fill(expected.begin() + 10, expected.begin() + 20, 0);
  EXPECT_EQ(answers, expected);
}

TEST_F(FaultyDrive, TheLogSaysEachChangeOnce) {
  enable();
  word_ = cia402::controlword::kQuickStop;
  cycle(100);
  std::vector<std::string> lines;
  for (const SimChange& change : drive_.changes()) {
    lines.push_back(describe(3, change));
  }
  const std::vector<std::string> expected = {
      "t_s=0.000000 node=3 nmt=pre_operational power=switch_on_disabled velocity=0 wheel=rests",
      "t_s=0.000000 node=3 nmt=operational power=switch_on_disabled velocity=0 wheel=rests",
      "t_s=0.002000 node=3 nmt=operational power=ready_to_switch_on velocity=0 wheel=rests",
      "t_s=0.006000 node=3 nmt=operational power=switched_on velocity=0 wheel=rests",
      "t_s=0.010000 node=3 nmt=operational power=operation_enabled velocity=0 wheel=rests",
      "t_s=0.016000 node=3 nmt=operational power=operation_enabled velocity=65 wheel=turns",
      "t_s=0.614000 node=3 nmt=operational power=quick_stop_active velocity=1000 wheel=turns",
      "t_s=0.630000 node=3 nmt=operational power=switch_on_disabled velocity=0 wheel=rests"};
  EXPECT_EQ(lines, expected);
}

TEST(SimFault, EachHasANameOfItsOwn) {
  std::set<std::string_view> names(sim_fault_names().begin(), sim_fault_names().end());
  EXPECT_EQ(names.size(), static_cast<std::size_t>(SimFault::kCount));
  for (int i = 0; i < static_cast<int>(SimFault::kCount); ++i) {
    EXPECT_EQ(sim_fault_of(name_of(static_cast<SimFault>(i))), static_cast<SimFault>(i));
  }
  EXPECT_EQ(sim_fault_of("none"), std::nullopt);
  EXPECT_EQ(name_of(SimFault::kEndlessStop), "endless_stop");
  EXPECT_EQ(name_of(SimFault::kFault), "fault");
}

TEST(SimDrives, EachHearsTheSyncAndTheNmtOfAnother) {
  hal::VirtualBus bus;
  SimDrives drives(bus.port(1), Robot{}, SimDrives::TimeFrom::kClock);
  drives.open();
  ASSERT_TRUE(drives.drive(Wheel::kRearLeft)
                  .script()
                  .events.push_back({.at = Instant(milliseconds(1)), .fault = SimFault::kForeignNmt, .value = 0x0100}));
  drives.update(Instant(milliseconds(2)));
  for (int wheel = 0; wheel < kWheels; ++wheel) {
    EXPECT_EQ(drives.drive(static_cast<Wheel>(wheel)).nmt_state(), NmtState::kOperational) << wheel;
  }
}

TEST(SimEncoder, NoiseIsBoundedAndTheSameForTheSameSeed) {
  const SimMotion still{DriveParameters{}};
  SimEncoder a(3, 7);
  SimEncoder b(3, 7);
  SimEncoder other(3, 8);
  std::set<std::int32_t> seen;
  int differences = 0;
  for (int i = 0; i < 1000; ++i) {
    for (SimEncoder* encoder : {&a, &b, &other}) {
      encoder->sample(still, false);
    }
    EXPECT_EQ(a.position(), b.position());
    differences += a.position() != other.position() ? 1 : 0;
    seen.insert(a.position());
  }
  EXPECT_EQ(seen, (std::set<std::int32_t>{-3, -2, -1, 0, 1, 2, 3}));
  EXPECT_GT(differences, 500);
}

}  // namespace
}  // namespace ivo::drivers
