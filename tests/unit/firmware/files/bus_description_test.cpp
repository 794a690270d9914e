#include "firmware/files/bus_description.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "drivers/canopen/bus_load.hpp"
#include "firmware/files/dbc_file.hpp"

namespace ivo::firmware {
namespace {

Robot robot_of(PdoLayout layout) {
  Robot robot;
  robot.pdo_layout = layout;
  return robot;
}

const BusMessage* message_at(const std::vector<BusMessage>& messages, std::uint16_t id) {
  const auto found = std::find_if(messages.begin(), messages.end(), [&](const BusMessage& m) { return m.id == id; });
  return found == messages.end() ? nullptr : &*found;
}

const BusSignal& signal_of(const BusMessage& message, const std::string& name) {
  return *std::find_if(message.signals.begin(), message.signals.end(),
                       [&](const BusSignal& s) { return s.name == name; });
}

TEST(BusDescription, HasEveryFrameOfTheScheduleWithItsSizeAndPeriod) {
  for (const PdoLayout layout : {PdoLayout::kOwn, PdoLayout::kShared}) {
    const Robot robot = robot_of(layout);
    const std::vector<BusMessage> messages = bus_messages(robot);
    const drivers::BusSchedule schedule = drivers::schedule_of(robot);
    for (const drivers::PeriodicFrame& frame : schedule.span()) {
      const BusMessage* const message = message_at(messages, frame.id);
      ASSERT_NE(message, nullptr) << std::hex << frame.id;
      EXPECT_EQ(message->bytes, frame.bytes) << std::hex << frame.id;
      EXPECT_EQ(message->cycle, frame.period) << std::hex << frame.id;
    }
  }
}

TEST(BusDescription, HasWhatComesWithoutAPeriod) {
  const std::vector<BusMessage> messages = bus_messages(Robot{});
  for (const int id : {0x000, 0x081, 0x084, 0x581, 0x584, 0x601, 0x604}) {
    const BusMessage* const message = message_at(messages, static_cast<std::uint16_t>(id));
    ASSERT_NE(message, nullptr) << std::hex << id;
    EXPECT_EQ(message->cycle, Duration::zero());
  }
}

TEST(BusDescription, NamesNoFrameAndNoSignalOfAFrameTwice) {
  for (const PdoLayout layout : {PdoLayout::kOwn, PdoLayout::kShared}) {
    std::set<std::string> names;
    std::set<std::uint16_t> ids;
    for (const BusMessage& message : bus_messages(robot_of(layout))) {
      EXPECT_TRUE(names.insert(message.name).second) << message.name;
      EXPECT_TRUE(ids.insert(message.id).second) << message.name;
      std::set<std::string> signals;
      for (const BusSignal& signal : message.signals) {
        EXPECT_TRUE(signals.insert(signal.name).second) << message.name << ' ' << signal.name;
      }
    }
  }
}

// What stands under one multiplexer value fills no bit twice and lies within the frame.
TEST(BusDescription, LetsNoSignalsOverlap) {
  for (const PdoLayout layout : {PdoLayout::kOwn, PdoLayout::kShared}) {
    for (const BusMessage& message : bus_messages(robot_of(layout))) {
      std::map<std::string, std::set<int>> taken;
      for (const BusSignal& signal : message.signals) {
        for (int bit = signal.start; bit < signal.start + signal.bits; ++bit) {
          EXPECT_LT(bit, 8 * message.bytes) << message.name << ' ' << signal.name;
          EXPECT_TRUE(taken[signal.mux].insert(bit).second) << message.name << ' ' << signal.name;
          EXPECT_FALSE(signal.mux != "M" && taken["M"].count(bit) > 0) << message.name << ' ' << signal.name;
        }
      }
    }
  }
}

TEST(BusDescription, GivesQuantitiesAtTheWheel) {
  Robot robot;
  robot.drives[1] = {
      .node_id = 9, .sign = -1, .gear_ratio = 20.0, .counts_per_turn = 1000.0, .velocity_per_radps = 5.0};
  const std::vector<BusMessage> messages = bus_messages(robot);
  const BusSignal angle = signal_of(*message_at(messages, 0x189), "WheelAngle");
  EXPECT_NEAR(angle.factor, -2 * 3.14159265358979 / 20'000, 1e-12);
  EXPECT_EQ(angle.unit, "rad");
  const BusSignal speed = signal_of(*message_at(messages, 0x209), "TargetWheelSpeed");
  EXPECT_NEAR(speed.factor, -1.0 / 100.0, 1e-12);
  EXPECT_EQ(speed.unit, "rad/s");
  EXPECT_TRUE(speed.is_signed);
}

TEST(BusDescription, OfTheSharedLayoutHasTheTargetsOfAPairInOneFrame) {
  const std::vector<BusMessage> messages = bus_messages(robot_of(PdoLayout::kShared));
  const BusMessage& front = *message_at(messages, 0x301);
  EXPECT_EQ(front.name, "RPDO2_FrontLeft_FrontRight");
  EXPECT_EQ(signal_of(front, "TargetWheelSpeed_FrontRight").start, 32);
  EXPECT_LT(signal_of(front, "TargetWheelSpeed_FrontRight").factor, 0) << "mounted the other way round";
  EXPECT_EQ(message_at(messages, 0x303)->name, "RPDO2_RearLeft_RearRight");
  EXPECT_EQ(message_at(bus_messages(Robot{}), 0x301), nullptr);
}

TEST(DbcFile, WritesAFrameItsSignalsAndItsPeriod) {
  const std::string text = dbc_text(Robot{});
  for (const char* const line :
       {"BU_: Controller FrontLeft FrontRight RearLeft RearRight\n", "\nBO_ 128 SYNC: 0 Controller\n",
        "\nBO_ 513 RPDO1_FrontLeft: 6 Controller\n SG_ SwitchOn : 0|1@1+ (1,0) [0|1] \"\" FrontLeft\n",
        "\nBA_ \"GenMsgCycleTime\" BO_ 513 2;\n", "\nBA_ \"GenMsgCycleTime\" BO_ 1919 50;\n",
        "\nBA_ \"Baudrate\" 1000000;\n",
        "\nVAL_ 1793 NmtState 0 \"boot-up\" 4 \"stopped\" 5 \"operational\" 127 \"pre-operational\" ;\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

TEST(DbcFile, GivesTheRangeOfANegativeFactorFromLowToHigh) {
  Robot robot;
  robot.drives[1].velocity_per_radps = 1.0;
  EXPECT_NE(
      dbc_text(robot).find("SG_ TargetWheelSpeed : 16|32@1- (-1,0) [-2147483647|2147483648] \"rad/s\" FrontRight"),
      std::string::npos);
}

}  // namespace
}  // namespace ivo::firmware
