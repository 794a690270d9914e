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

const ClientAddress kAna{.group = "192.0.2.1", .this_machine = false};
const ClientAddress kBen{.group = "192.0.2.2", .this_machine = false};
const ClientAddress kHere{.group = "127.0.0.1", .this_machine = true};

ClientAddress stranger(int number) { return {.group = std::to_string(number), .this_machine = false}; }

bool is_right(const PairingCode::Outcome& outcome) { return std::holds_alternative<PairingCode::Right>(outcome); }

/// Until it locks: for how long.
int guess_until_locked(PairingCode& code, Instant now) {
  for (int i = 1; i < PairingCode::kTries; ++i) {
    EXPECT_EQ(std::get<PairingCode::Wrong>(code.test("none", kAna, now)).left, PairingCode::kTries - i);
  }
  const auto locked = std::get<PairingCode::Locked>(code.test("none", kAna, now));
  EXPECT_TRUE(locked.anew);
  return locked.wait_s;
}

TEST(PairingCode, CountsOnce) {
  PairingCode code(counting());
  const std::string digits = code.digits();
  EXPECT_TRUE(is_right(code.test(digits, kAna, kCodeStart)));
  EXPECT_NE(code.digits(), digits);
  EXPECT_TRUE(std::holds_alternative<PairingCode::Wrong>(code.test(digits, kAna, kCodeStart)));
}

TEST(PairingCode, LocksOutWhoGuessesAndNobodyElse) {
  PairingCode code(counting());
  const std::string digits = code.digits();
  EXPECT_EQ(guess_until_locked(code, kCodeStart), 30);
  const auto again = std::get<PairingCode::Locked>(code.test(digits, kAna, kCodeStart + 29s));
  EXPECT_EQ(again.wait_s, 1);
  EXPECT_FALSE(again.anew);
  EXPECT_EQ(code.digits(), digits);
  EXPECT_TRUE(is_right(code.test(digits, kBen, kCodeStart)));
  EXPECT_TRUE(is_right(code.test(code.digits(), kAna, kCodeStart + 30s)));
}

TEST(PairingCode, LocksForTwiceAsLongEachTimeUpToAQuarterOfAnHour) {
  PairingCode code(counting());
  Instant now = kCodeStart;
  for (const int wait_s : {30, 60, 120, 240, 480, 900, 900}) {
    EXPECT_EQ(guess_until_locked(code, now), wait_s);
    now += std::chrono::seconds(wait_s);
  }
}

TEST(PairingCode, ForgivesAfterARightOneAndAfterAnHour) {
  PairingCode code(counting());
  EXPECT_EQ(guess_until_locked(code, kCodeStart), 30);
  EXPECT_TRUE(is_right(code.test(code.digits(), kAna, kCodeStart + 30s)));
  EXPECT_EQ(guess_until_locked(code, kCodeStart + 30s), 30);
  EXPECT_EQ(guess_until_locked(code, kCodeStart + 30s + PairingCode::kSpan), 30);
}

TEST(PairingCode, IsClosedAfterAHundredWrongOnesOfAllUntilTheHourIsOver) {
  PairingCode code(counting());
  const std::string before = code.digits();
  for (int i = 1; i < PairingCode::kWrongOfAll; ++i) {
    EXPECT_TRUE(std::holds_alternative<PairingCode::Wrong>(code.test("none", stranger(i), kCodeStart)));
  }
  EXPECT_TRUE(std::get<PairingCode::Closed>(code.test("none", stranger(100), kCodeStart + 60s)).anew);
  EXPECT_NE(code.digits(), before);
  const auto closed = std::get<PairingCode::Closed>(code.test(code.digits(), kBen, kCodeStart + 61s));
  EXPECT_EQ(closed.wait_s, 3539);
  EXPECT_FALSE(closed.anew);
  EXPECT_TRUE(is_right(code.test(code.digits(), kHere, kCodeStart + 61s)));
  EXPECT_TRUE(is_right(code.test(code.digits(), kBen, kCodeStart + PairingCode::kSpan)));
}

TEST(PairingCode, IsNotClosedByThisMachine) {
  PairingCode code(counting());
  Instant now = kCodeStart;
  for (int i = 0; i < 2 * PairingCode::kWrongOfAll; ++i) {
    (void)code.test("none", kHere, now);
    now += 1s;
  }
  EXPECT_TRUE(is_right(code.test(code.digits(), kBen, now)));
}

TEST(PairingCode, RemembersTheLastSixtyFourAddresses) {
  PairingCode code(counting());
  for (int i = 0; i <= static_cast<int>(PairingCode::kAddresses); ++i) {
    EXPECT_EQ(std::get<PairingCode::Wrong>(code.test("none", stranger(i), kCodeStart)).left, 4);
  }
  EXPECT_EQ(std::get<PairingCode::Wrong>(code.test("none", stranger(1), kCodeStart)).left, 3);
  EXPECT_EQ(std::get<PairingCode::Wrong>(code.test("none", stranger(0), kCodeStart)).left, 4);
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
