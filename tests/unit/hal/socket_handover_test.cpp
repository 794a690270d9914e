#include "hal/linux/socket_handover.hpp"

#include <gtest/gtest.h>

namespace ivo::hal {
namespace {

TEST(SocketHandover, GivesEachReportOnceAndWhole) {
  SocketHandover handover;
  EXPECT_FALSE(handover.take_report().has_value());
  const LinkReport report{.present = true,
                          .up = false,
                          .controller = BusState::kPassive,
                          .counts_errors = true,
                          .transmit_errors = 0xABCD,
                          .receive_errors = 0xFEDC};
  handover.begin_look();
  handover.report(report);
  EXPECT_EQ(handover.take_report(), report);
  EXPECT_FALSE(handover.take_report().has_value());
  handover.begin_look();
  handover.report(report);
  EXPECT_EQ(handover.take_report(), report) << "seen again is news again";
}

TEST(SocketHandover, KeepsBackWhatWasSeenBeforeTheLoopKnewBetter) {
  SocketHandover handover;
  handover.begin_look();  // the kernel says active, then the controller goes off, and an error frame tells the loop
  handover.note_change();
  handover.report({.controller = BusState::kActive});
  EXPECT_FALSE(handover.take_report().has_value());
  handover.begin_look();
  handover.report({.controller = BusState::kOff});
  ASSERT_TRUE(handover.take_report().has_value());
}

TEST(SocketHandover, CountsChangesBeyondAByte) {
  SocketHandover handover;
  for (int i = 0; i < 1000; ++i) {
    handover.note_change();
    handover.begin_look();
    handover.report({});
    ASSERT_TRUE(handover.take_report().has_value()) << i;
  }
}

}  // namespace
}  // namespace ivo::hal
