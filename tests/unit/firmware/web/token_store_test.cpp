#include "firmware/web/token_store.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "tests/support/scratch_folder.hpp"

namespace ivo::firmware::web {
namespace {

class TokenStoreTest : public testing::Test {
 protected:
  TokenStore open() const { return std::move(TokenStore::open(folder_.path())).value(); }
  std::string refusal(std::string_view contents) const {
    folder_.put("tokens", contents);
    const Result<TokenStore> store = TokenStore::open(folder_.path());
    return store ? "taken" : store.error().message.substr(folder_.path().size());
  }

  ScratchFolder folder_;
  const std::string hash_ = std::string(64, 'a');
};

TEST_F(TokenStoreTest, KnowsWhomItHasGivenATokenAndNobodyElse) {
  TokenStore store = open();
  const std::string token = store.add("Ana", Role::kOperator).value();
  EXPECT_EQ(token.size(), 64U);
  ASSERT_TRUE(store.find(token).has_value());
  EXPECT_EQ(store.find(token)->name, "Ana");
  EXPECT_EQ(store.find(token)->role, Role::kOperator);
  EXPECT_FALSE(store.find("").has_value());
  EXPECT_FALSE(store.find(token.substr(1)).has_value());
  EXPECT_FALSE(store.find(store.find(token)->hash).has_value());
}

TEST_F(TokenStoreTest, OutlivesItsProgramAndKeepsNoToken) {
  const std::string token = open().add("Ana", Role::kViewer).value();
  EXPECT_EQ(open().find(token)->role, Role::kViewer);
  std::ifstream file(folder_.path("tokens"));
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(text.find(token), std::string::npos);
  struct stat status {};
  ASSERT_EQ(::stat(folder_.path("tokens").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0600U);
}

TEST_F(TokenStoreTest, SeesWhatAnotherProcessAdds) {
  TokenStore one = open();
  TokenStore other = open();
  const std::string first = one.add("first", Role::kOperator).value();
  const std::string second = other.add("second", Role::kOperator).value();
  EXPECT_TRUE(one.find(second).has_value());
  EXPECT_TRUE(other.find(first).has_value());
  EXPECT_EQ(one.size(), 2U);
}

TEST_F(TokenStoreTest, ForgetsOneByItsDigitsAndNobodyElse) {
  TokenStore store = open();
  TokenStore other = open();
  const std::string ana = store.add("Ana", Role::kOperator).value();
  const std::string luis = store.add("Luis", Role::kViewer).value();
  const Paired paired = *other.find(ana);
  EXPECT_TRUE(other.holds(paired));
  EXPECT_EQ(store.forget(paired.hash.substr(0, TokenStore::kIdDigits)).value().name, "Ana");
  EXPECT_FALSE(store.find(ana).has_value());
  EXPECT_FALSE(other.holds(paired));
  EXPECT_TRUE(other.find(luis).has_value());
  EXPECT_EQ(open().size(), 1U);
}

TEST_F(TokenStoreTest, ForgetsNobodyWhoseDigitsAreTooFewOrUnknown) {
  TokenStore store = open();
  const std::string hash = store.find(store.add("Ana", Role::kOperator).value())->hash;
  for (const std::string& id : {std::string(), hash.substr(0, 7), std::string("Ana"), hash + "0"}) {
    EXPECT_EQ(store.forget(id).error().message,
              "\"" + id + "\" is nobody's; expected the 8 digits that ivo-console --paired shows");
  }
  EXPECT_EQ(store.size(), 1U);
}

TEST_F(TokenStoreTest, ForgetsAllWithTheFile) {
  TokenStore store = open();
  const Paired paired = *store.find(store.add("Ana", Role::kOperator).value());
  std::filesystem::remove(folder_.path("tokens"));
  EXPECT_FALSE(store.holds(paired));
}

TEST_F(TokenStoreTest, ForgetsTheOldestWhenThereAreTooMany) {
  TokenStore store = open();
  const std::string first = store.add("first", Role::kOperator).value();
  const std::string second = store.add("second", Role::kOperator).value();
  for (std::size_t i = 2; i <= TokenStore::kMost; ++i) {
    ASSERT_TRUE(store.add("more", Role::kOperator).ok());
  }
  EXPECT_EQ(store.size(), TokenStore::kMost);
  EXPECT_FALSE(store.find(first).has_value());
  EXPECT_TRUE(store.find(second).has_value());
}

TEST_F(TokenStoreTest, RefusesADamagedFileByItsLine) {
  const std::string first = "ivo-console tokens 1\n";
  EXPECT_EQ(refusal(first), "taken");
  EXPECT_EQ(refusal(first + hash_ + " viewer Ana's tablet\n"), "taken");
  EXPECT_TRUE(refusal("").starts_with("/tokens:1: no list of tokens"));
  EXPECT_TRUE(refusal("ivo-console tokens 2\n").starts_with("/tokens:1: no list of tokens"));
  for (const std::string& line : {hash_ + " owner Ana", hash_ + " viewer", hash_ + " viewer ", hash_ + "a viewer Ana",
                                  hash_.substr(1) + "g viewer Ana", std::string("\n"), hash_ + " viewer \x01"}) {
    EXPECT_TRUE(refusal(first + line + "\n").starts_with("/tokens:2: damaged; expected")) << line;
  }
}

TEST_F(TokenStoreTest, KeepsWhoIsKnownWhenTheFileIsDamagedMeanwhile) {
  TokenStore store = open();
  const std::string token = store.add("Ana", Role::kOperator).value();
  folder_.put("tokens", "nonsense");
  EXPECT_TRUE(store.find(token).has_value());
  EXPECT_FALSE(store.add("Ben", Role::kOperator).ok());
}

TEST(TidyName, IsOneShortLine) {
  EXPECT_EQ(tidy_name("Ana's tablet"), "Ana's tablet");
  EXPECT_EQ(tidy_name("  two\nlines\t"), "two lines");
  EXPECT_EQ(tidy_name(""), "a screen");
  EXPECT_EQ(tidy_name("\n\x7f"), "a screen");
  EXPECT_EQ(tidy_name(std::string(39, 'x') + "\xc3\xa9"), std::string(39, 'x'));
  const std::string long_one(100, 'y');
  EXPECT_EQ(tidy_name(tidy_name(long_one)), tidy_name(long_one));
}

}  // namespace
}  // namespace ivo::firmware::web
