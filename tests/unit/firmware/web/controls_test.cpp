#include "firmware/web/controls.hpp"

#include <gtest/gtest.h>

namespace ivo::firmware::web {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

class ControlsTest : public testing::Test {
 protected:
  bool request(Screen screen, Duration at) {
    controls_.turn(start_ + at);
    return controls_.request(screen, "owner " + std::to_string(screen), start_ + at);
  }

  const Instant start_{100s};
  Controls controls_;
};

TEST_F(ControlsTest, AreGivenAtOnceWhenNobodyHoldsThem) {
  EXPECT_FALSE(controls_.holder().has_value());
  EXPECT_TRUE(request(1, 0s));
  EXPECT_TRUE(controls_.held_by(1));
  EXPECT_FALSE(controls_.requester().has_value());
  EXPECT_TRUE(request(1, 1s));  // again: nothing
  EXPECT_TRUE(controls_.held_by(1));
}

TEST_F(ControlsTest, AreGivenByWhoHoldsThemAlone) {
  EXPECT_TRUE(request(1, 0s));
  EXPECT_FALSE(controls_.give(1));  // nobody has asked
  EXPECT_TRUE(request(2, 0s));
  EXPECT_FALSE(controls_.give(2));
  EXPECT_FALSE(controls_.keep(2));
  EXPECT_FALSE(controls_.release(2));
  EXPECT_TRUE(controls_.give(1));
  EXPECT_TRUE(controls_.held_by(2));
  EXPECT_FALSE(controls_.requester().has_value());
}

TEST_F(ControlsTest, AreKept) {
  EXPECT_TRUE(request(1, 0s));
  EXPECT_TRUE(request(2, 0s));
  EXPECT_TRUE(controls_.keep(1));
  controls_.turn(start_ + 60s);
  EXPECT_TRUE(controls_.held_by(1));
}

TEST_F(ControlsTest, AreGivenWithoutAnAnswerForTenSeconds) {
  EXPECT_TRUE(request(1, 0s));
  EXPECT_TRUE(request(2, 1s));
  EXPECT_TRUE(request(2, 9s));  // to ask again does not begin the time anew
  controls_.turn(start_ + 10999ms);
  EXPECT_TRUE(controls_.held_by(1));
  controls_.turn(start_ + 11s);
  EXPECT_TRUE(controls_.held_by(2));
}

TEST_F(ControlsTest, HaveOneWhoWaits) {
  EXPECT_TRUE(request(1, 0s));
  EXPECT_TRUE(request(2, 0s));
  EXPECT_FALSE(request(3, 0s));
  controls_.went(2, start_);
  EXPECT_TRUE(request(3, 0s));
}

TEST_F(ControlsTest, AreFreeTwoSecondsAfterTheirHolderHasGone) {
  EXPECT_TRUE(request(1, 0s));
  controls_.went(1, start_);
  controls_.turn(start_ + 1999ms);
  EXPECT_TRUE(controls_.holder().has_value());
  controls_.turn(start_ + 2s);
  EXPECT_FALSE(controls_.holder().has_value());
}

TEST_F(ControlsTest, GoToWhoWaitsWhenTheirHolderHasGone) {
  EXPECT_TRUE(request(1, 0s));
  EXPECT_TRUE(request(2, 0s));
  controls_.went(1, start_);
  controls_.turn(start_ + 2s);
  EXPECT_TRUE(controls_.held_by(2));
}

TEST_F(ControlsTest, StayWithAScreenThatComesBackInTime) {
  EXPECT_TRUE(request(1, 0s));
  controls_.came(5, "owner 1");  // a second screen of one that is there takes nothing
  EXPECT_TRUE(controls_.held_by(1));
  controls_.went(1, start_);
  EXPECT_FALSE(controls_.held_for("owner 1"));
  controls_.came(6, "owner 2");
  EXPECT_FALSE(controls_.held_by(6));
  controls_.came(7, "owner 1");
  EXPECT_TRUE(controls_.held_by(7));
  EXPECT_TRUE(controls_.held_for("owner 1"));
  controls_.turn(start_ + 60s);
  EXPECT_TRUE(controls_.held_by(7));
}

TEST_F(ControlsTest, AreReleasedToWhoWaitsOrToNobody) {
  EXPECT_TRUE(request(1, 0s));
  EXPECT_TRUE(request(2, 0s));
  EXPECT_TRUE(controls_.release(1));
  EXPECT_TRUE(controls_.held_by(2));
  EXPECT_TRUE(controls_.release(2));
  EXPECT_FALSE(controls_.holder().has_value());
}

}  // namespace
}  // namespace ivo::firmware::web
