#include "config/base/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace ivo {
namespace {

Result<int> half_of(int even) {
  if (even % 2 != 0) {
    return Error{"value: " + std::to_string(even) + " is odd; expected an even number"};
  }
  return even / 2;
}

Result<void> accept(bool good) {
  if (!good) {
    return Error{"refused"};
  }
  return {};
}

TEST(Result, HoldsTheValueWhenAllWentWell) {
  const Result<int> result = half_of(8);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(result.value(), 4);
}

TEST(Result, HoldsTheReasonWhenThereIsNoValue) {
  const Result<int> result = half_of(7);
  ASSERT_FALSE(result.ok());
  EXPECT_FALSE(static_cast<bool>(result));
  EXPECT_EQ(result.error().message, "value: 7 is odd; expected an even number");
}

TEST(Result, TellsAValueFromAnErrorWhenBothAreText) {
  EXPECT_TRUE(Result<std::string>(std::string("text")).ok());
  EXPECT_FALSE(Result<std::string>(Error{"text"}).ok());
}

TEST(Result, GivesItsValueAway) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 5);
}

TEST(Result, LetsItsValueBeChangedInPlace) {
  Result<std::vector<int>> result = std::vector<int>{1};
  result.value().push_back(2);
  EXPECT_EQ(result.value().size(), 2U);
}

TEST(Result, OfNothingIsEitherFineOrAReason) {
  EXPECT_TRUE(accept(true).ok());
  ASSERT_FALSE(accept(false).ok());
  EXPECT_EQ(accept(false).error().message, "refused");
}

TEST(ResultDeathTest, AskingForWhatItDoesNotHoldEndsTheProgram) {
  const Result<int> bad = Error{"refused"};
  const Result<int> good = 1;
  const Result<void> fine;
  EXPECT_DEATH((void)bad.value(), "");
  EXPECT_DEATH((void)good.error(), "");
  EXPECT_DEATH((void)fine.error(), "");
}

}  // namespace
}  // namespace ivo
