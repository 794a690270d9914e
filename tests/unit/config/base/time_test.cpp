#include "config/base/time.hpp"

#include <gtest/gtest.h>

namespace ivo {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""ns;

TEST(Time, SecondsBecomeTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(0.002), 2ms);
  EXPECT_EQ(from_seconds(-0.002), -2ms);
  EXPECT_EQ(from_seconds(1.4e-9), 1ns);
  EXPECT_EQ(from_seconds(1.6e-9), 2ns);
  EXPECT_EQ(from_seconds(-1.6e-9), -2ns);
}

TEST(Time, DurationsBecomeSeconds) {
  EXPECT_DOUBLE_EQ(seconds(2ms), 0.002);
  EXPECT_DOUBLE_EQ(seconds(-1500ms), -1.5);
}

}  // namespace
}  // namespace ivo
