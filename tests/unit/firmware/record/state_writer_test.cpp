#include "firmware/record/state_writer.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace ivo::firmware {
namespace {

class StateWriterTest : public ::testing::Test {
 protected:
  StateWriterTest() {
    std::string folder = ::testing::TempDir() + "writer.XXXXXX";
    folder_ = ::mkdtemp(folder.data());
    log_ = ::open((folder_ + "/log").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  }
  ~StateWriterTest() override {
    ::close(log_);
    std::filesystem::remove_all(folder_);
  }
  [[nodiscard]] StateFile file() const { return StateFile::create(folder_ + "/state", 1, {}, "first").value(); }
  [[nodiscard]] std::string newest() const { return StateFile::read(folder_ + "/state", 1).value().state; }

  std::string folder_;
  int log_ = -1;
};

TEST_F(StateWriterTest, WhatIsWaitedForIsOnTheDisk) {
  StateWriter writer(file(), log_);
  ASSERT_TRUE(writer.keep_and_wait("second").ok());
  EXPECT_EQ(newest(), "second");
  ASSERT_TRUE(writer.keep_and_wait("third").ok());
  EXPECT_EQ(newest(), "third");
}

TEST_F(StateWriterTest, OfMoreThanTheDiskTakesTheNewestIsKept) {
  {
    StateWriter writer(file(), log_);
    for (int i = 0; i < 10000; ++i) {
      writer.keep(std::to_string(i));
    }
  }
  EXPECT_EQ(newest(), "9999");
}

TEST_F(StateWriterTest, AFailureIsSaidAndThenTheNextIsTried) {
  StateWriter writer(file(), log_);
  std::filesystem::rename(folder_, folder_ + ".away");
  const Result<void> lost = writer.keep_and_wait("lost");
  EXPECT_FALSE(lost.ok());
  EXPECT_TRUE(writer.failure().has_value());
  std::filesystem::rename(folder_ + ".away", folder_);
  ASSERT_TRUE(writer.keep_and_wait("kept").ok());
  EXPECT_FALSE(writer.failure().has_value());
  EXPECT_EQ(newest(), "kept");
}

}  // namespace
}  // namespace ivo::firmware
