#include "firmware/web/pairing_code.hpp"

#include <gtest/gtest.h>

#include <set>

namespace ivo::firmware::web {
namespace {

using std::chrono_literals::operator""s;

/// Counts on: each code another.
RandomSource counting() {
  return [next = 0](std::size_t count) mutable { return std::string(count, static_cast<char>(++next)); };
}

const Instant kCodeStart(1000s);

TEST(PairingCode, IsSixDigitsAndOfTheKernelsRandomness) {
  std::set<std::string> codes;
  for (int i = 0; i < 100; ++i) {
    const PairingCode code;
    EXPECT_EQ(code.digits().size(), 6U);
    EXPECT_EQ(code.digits().find_first_not_of("0123456789"), std::string::npos);
    codes.insert(code.digits());
  }
  EXPECT_GT(codes.size(), 90U);
}

TEST(PairingCode, HasZerosInFront) {
  const PairingCode code([](std::size_t count) { return std::string(count, '\0'); });
  EXPECT_EQ(code.digits(), "000000");
}

TEST(PairingCode, CountsOnce) {
  PairingCode code(counting());
  const std::string digits = code.digits();
  EXPECT_TRUE(std::holds_alternative<PairingCode::Right>(code.test(digits, kCodeStart)));
  EXPECT_NE(code.digits(), digits);
  EXPECT_TRUE(std::holds_alternative<PairingCode::Wrong>(code.test(digits, kCodeStart)));
}

TEST(PairingCode, LocksForHalfAMinuteAfterFiveWrongOnes) {
  PairingCode code(counting());
  const std::string before = code.digits();
  for (const int left : {4, 3, 2, 1}) {
    EXPECT_EQ(std::get<PairingCode::Wrong>(code.test("none", kCodeStart)).left, left);
  }
  EXPECT_EQ(std::get<PairingCode::Locked>(code.test("none", kCodeStart)).wait_s, 30);
  EXPECT_NE(code.digits(), before);
  const std::string digits = code.digits();
  EXPECT_EQ(std::get<PairingCode::Locked>(code.test(digits, kCodeStart + 29s)).wait_s, 1);
  EXPECT_TRUE(std::holds_alternative<PairingCode::Right>(code.test(digits, kCodeStart + 30s)));
}

TEST(PairingCode, ForgivesAfterARightOne) {
  PairingCode code(counting());
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 4; ++i) {
      EXPECT_TRUE(std::holds_alternative<PairingCode::Wrong>(code.test("", kCodeStart)));
    }
    EXPECT_TRUE(std::holds_alternative<PairingCode::Right>(code.test(code.digits(), kCodeStart)));
  }
}

TEST(Secrets, AreComparedWhole) {
  EXPECT_TRUE(same_secret("123456", "123456"));
  EXPECT_FALSE(same_secret("123456", "123457"));
  EXPECT_FALSE(same_secret("123456", "12345"));
  EXPECT_FALSE(same_secret("", "1"));
}

TEST(Secrets, AreHashedAsTheStandardSays) {
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace ivo::firmware::web
