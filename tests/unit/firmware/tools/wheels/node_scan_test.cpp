#include "firmware/tools/wheels/node_scan.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/eds/shipped_eds.hpp"
#include "drivers/sim/sim_drives.hpp"
#include "firmware/tools/wheels/node_table.hpp"
#include "hal/sim/manual_clock.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::firmware {
namespace {

using drivers::NmtState;
using std::chrono_literals::operator""ms;

class ScanRig {
 public:
  explicit ScanRig(const Robot& base = Robot{}, const drivers::SimDrives::Scripts& scripts = {})
      : base_(base), drives(bus.port(1), base_, drivers::SimDrives::TimeFrom::kClock, scripts) {
    drives.open();
  }

  void run(const NodeScan::NodeIds& asked = NodeScan::everyone()) {
    scan = std::make_unique<NodeScan>(bus.port(0), robot, asked);
    for (int i = 0; i < 10'000 && !scan->done(); ++i) {
      scan->cycle(clock.now());
      clock.sleep_until(clock.now() + 2ms);
      if (stranger && i % 25 == 0) {
        bus.port(2).send({&*stranger, 1}, clock.now());
      }
      drives.update(clock.now());
      std::array<hal::ReceivedFrame, 256> frames;
      const std::size_t count = bus.port(3).receive(frames, clock.now());
      for (std::size_t k = 0; k < count; ++k) {
        log.push_back(frames[k].frame);
        play_prankster(frames[k].frame);
      }
    }
    EXPECT_TRUE(scan->done());
  }

  /// Answers whatever it is asked with a command to a terminal.
  void play_prankster(const hal::CanFrame& request) {
    if (prankster != 0 && request.id == 0x600 + prankster && request.data[0] == 0x40) {
      const auto& asked = request.data;
      const hal::CanFrame answer{.id = static_cast<std::uint16_t>(0x580 + prankster),
                                 .size = 8,
                                 .data = {0x43, asked[1], asked[2], asked[3], 0x1B, '[', 0xFF, 'J'}};
      bus.port(2).send({&answer, 1}, clock.now());
    }
  }

  /// Frames that the scan sent.
  [[nodiscard]] std::size_t requests() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(log, [](const hal::CanFrame& frame) { return (frame.id & 0x780) == 0x600; }));
  }

  Robot robot;
  Robot base_;
  hal::VirtualBus bus;
  hal::ManualClock clock;
  drivers::SimDrives drives;
  std::optional<hal::CanFrame> stranger;  ///< sent now and then by somebody else
  std::uint8_t prankster = 0;             ///< node-id; 0: none
  std::unique_ptr<NodeScan> scan;
  std::vector<hal::CanFrame> log;
};

TEST(NodeScan, FindsTheFourDrivesAndWhatTheySay) {
  Robot base;
  base.drives[1].vendor_id = 0x5A;
  base.drives[1].product_code = 0x1234;
  ScanRig rig(base);
  rig.run();
  for (std::uint8_t id = 1; id <= NodeScan::kNodes; ++id) {
    EXPECT_EQ(rig.scan->node(id).there(), id <= 4) << int{id};
  }
  const ScannedNode& node = rig.scan->node(2);
  EXPECT_EQ(node.value(ScanObject::kDeviceType), 0x0002'0192U);
  EXPECT_EQ(node.value(ScanObject::kVendor), 0x5AU);
  EXPECT_EQ(node.value(ScanObject::kProduct), 0x1234U);
  EXPECT_EQ(node.value(ScanObject::kModes), 0x104U);
  EXPECT_EQ(node.value(ScanObject::kRevision), 0x0001'0000U) << "of its EDS";
  ASSERT_TRUE(node.name.has_value());
  EXPECT_EQ(node.name->view(), drivers::ivo_drive_eds().text_of(*drivers::ivo_drive_eds().find({0x1008, 0})));
}

TEST(NodeScan, OnlyReads) {
  ScanRig rig;
  rig.run();
  EXPECT_GT(rig.requests(), 127U);
  for (const hal::CanFrame& frame : rig.log) {
    if (frame.id == 0x000 || (frame.id & 0x780) == 0x600 || (frame.id & 0x780) == 0x200) {
      EXPECT_TRUE(ReadingBus::reads(frame)) << std::hex << frame.id;
    }
  }
  EXPECT_EQ(rig.scan->refused_frames(), 0U);
}

TEST(NodeScan, DisturbsNoControllerThatIsRunning) {
  const std::vector<hal::CanFrame> said{{.id = 0x080, .size = 0, .data = {}},
                                        {.id = 0x77F, .size = 1, .data = {5}},
                                        {.id = 0x000, .size = 2, .data = {1, 0}},
                                        {.id = 0x203, .size = 6, .data = {}},
                                        {.id = 0x603, .size = 8, .data = {0x40}}};
  for (const hal::CanFrame& frame : said) {
    ScanRig rig;
    rig.stranger = frame;
    rig.run();
    EXPECT_EQ(rig.scan->controller(), frame.id);
    EXPECT_EQ(rig.bus.port(0).counters().sent, 0U);
    EXPECT_TRUE(rig.scan->node(1).booted) << "it was heard all the same";
  }
}

TEST(NodeScan, NamesAStrangerByItsHeartbeat) {
  ScanRig rig;
  rig.stranger = hal::CanFrame{.id = 0x700 + 17, .size = 1, .data = {0x7F}};
  rig.run();
  EXPECT_EQ(rig.scan->node(17).state, NmtState::kPreOperational);
  EXPECT_FALSE(rig.scan->node(17).answered);
}

TEST(NodeScan, EndsWhenNobodyIsThere) {
  drivers::SimDrives::Scripts scripts;
  for (auto& script : scripts) {
    script.silent_from = Instant{};
  }
  ScanRig rig(Robot{}, scripts);
  rig.run();
  EXPECT_FALSE(rig.scan->node(1).there());
  EXPECT_LT(rig.clock.now(), Instant(3000ms));
}

TEST(NodeScan, AskedAboutOursItAsksNobodyElse) {
  ScanRig rig;
  NodeScan::NodeIds ours;
  ours.set(3);
  rig.run(ours);
  for (const hal::CanFrame& frame : rig.log) {
    EXPECT_TRUE((frame.id & 0x780) != 0x600 || frame.id == 0x603);
  }
}

TEST(NodeScan, GoesOnWhenANodeRefusesAnObject) {
  drivers::SimDrives::Scripts scripts;
  scripts[0].refusal = {drivers::object::kSupportedModes, drivers::SdoAbort::kNoObject};
  scripts[1].refusal = {{0x1000, 0}, drivers::SdoAbort::kGeneral};
  ScanRig rig(Robot{}, scripts);
  rig.run();
  EXPECT_FALSE(rig.scan->node(1).value(ScanObject::kModes).has_value());
  EXPECT_TRUE(rig.scan->node(1).value(ScanObject::kStatusword).has_value());
  EXPECT_TRUE(rig.scan->node(2).answered) << "an abort is an answer";
}

TEST(NodeScan, GoesWithoutTheNameOfANodeThatHasNone) {
  drivers::SimDrives::Scripts scripts;
  scripts[0].refusal = {{0x1008, 0}, drivers::SdoAbort::kNoObject};
  ScanRig rig(Robot{}, scripts);
  rig.run();
  EXPECT_FALSE(rig.scan->node(1).name.has_value());
  EXPECT_TRUE(rig.scan->node(2).name.has_value());
}

TEST(NodeTable, ShowsOfANameWhatCanBeSeenAndNothingThatMovesTheCursor) {
  ScanRig rig;
  rig.prankster = 40;
  rig.run();
  ASSERT_TRUE(rig.scan->node(40).name.has_value());
  EXPECT_EQ(rig.scan->node(40).name->view(), "\x1b[\xFFJ") << "as it came";
  const wheels::NodeTable table = wheels::node_table(*rig.scan, rig.robot);
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_TRUE(table.rows[5].ends_with("  ?[?J")) << table.rows[5];
}

TEST(NodeTable, SaysThatAllIsWell) {
  ScanRig rig;
  rig.run();
  const wheels::NodeTable table = wheels::node_table(*rig.scan, rig.robot);
  EXPECT_TRUE(table.as_expected);
  EXPECT_EQ(table.nodes, 4);
  EXPECT_EQ(table.rows.size(), 5U);
  EXPECT_TRUE(table.remarks.empty());
}

TEST(NodeTable, NamesWhatIsMissingUnknownOrDifferent) {
  Robot base;
  base.drives[2].node_id = 33;  // and nobody has 3
  drivers::SimDrives::Scripts scripts;
  scripts[0].supported_modes = 0x1;
  scripts[1].device_type = 0x0002'0191;
  ScanRig rig(base, scripts);
  rig.robot.drives[3].vendor_id = 0x99;
  rig.run();
  const wheels::NodeTable table = wheels::node_table(*rig.scan, rig.robot);
  std::string text;
  for (const wheels::Remark& remark : table.remarks) {
    text += remark.label + " " + remark.text + "\n";
  }
  EXPECT_EQ(text,
            "differs node 1 (front left): offers PP, expected CSV or PV\n"
            "differs node 2 (front right): device profile 401, expected 402, a drive\n"
            "missing node 3 (rear left): no answer; is it powered, on this bus and set to this node-id?\n"
            "differs node 4 (rear right): vendor 00000000h, the robot file expects 00000099h\n"
            "unknown node 33: no wheel of the robot file has it\n");
  EXPECT_FALSE(table.as_expected);
}

TEST(NodeTable, SaysWhatADriveInFaultHas) {
  drivers::SimDrives::Scripts scripts;
  scripts[2].fault_at = Instant{};
  ScanRig rig(Robot{}, scripts);
  rig.run();
  EXPECT_EQ(wheels::fault_text(*rig.scan, rig.robot, Wheel::kRearLeft),
            "node 3 (rear left): in fault (statusword 1218h), error 7300h: sensor");
  EXPECT_FALSE(wheels::fault_text(*rig.scan, rig.robot, Wheel::kFrontLeft).has_value());
}

TEST(ReadingBus, LetsNothingPassThatIsNoReading) {
  hal::VirtualBus bus;
  ReadingBus reading(bus.port(0));
  for (std::uint16_t id = 0; id <= 0x7FF; ++id) {
    for (int command = 0; command < 256; ++command) {
      const hal::CanFrame frame{.id = id, .size = 8, .data = {static_cast<std::uint8_t>(command)}};
      const bool request = id > 0x600 && id <= 0x67F;
      const bool reads = request && (command == 0x40 || command == 0x60 || command == 0x70 || command == 0x80);
      ASSERT_EQ(ReadingBus::reads(frame), reads) << std::hex << id << " " << command;
    }
  }
  const hal::CanFrame nmt{.id = 0, .size = 2, .data = {1, 0}};
  EXPECT_EQ(reading.send({&nmt, 1}, Instant{}), 0U);
  EXPECT_EQ(bus.port(0).counters().sent, 0U);
}

}  // namespace
}  // namespace ivo::firmware
