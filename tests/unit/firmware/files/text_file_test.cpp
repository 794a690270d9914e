#include "firmware/files/text_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace ivo::firmware {
namespace {

TEST(TextFile, ReadsBackWhatItWrote) {
  const ScratchFolder folder;
  const std::string contents("one\ntwo\0three\n", 14);
  ASSERT_TRUE(write_file(folder.path("a.txt"), contents).ok());
  EXPECT_EQ(read_file(folder.path("a.txt")).value(), contents);
}

TEST(TextFile, ReplacesAnOlderFileAndLeavesNothingElse) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder.path("a.txt"), "a long first version").ok());
  ASSERT_TRUE(write_file(folder.path("a.txt"), "second").ok());
  EXPECT_EQ(read_file(folder.path("a.txt")).value(), "second");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(TextFile, RefusesToReadWhatIsNotThereOrIsAFolder) {
  const ScratchFolder folder;
  EXPECT_EQ(read_file(folder.path("none.txt")).error().message,
            folder.path("none.txt") + ": cannot be read: No such file or directory");
  EXPECT_EQ(read_file(folder.path()).error().message, folder.path() + ": cannot be read: Is a directory");
}

TEST(TextFile, RefusesToWriteIntoAFolderThatIsNotThere) {
  const ScratchFolder folder;
  EXPECT_EQ(write_file(folder.path("none/a.txt"), "x").error().message,
            folder.path("none/a.txt") + ": cannot be written: No such file or directory");
}

TEST(TextFile, KnowsBeforehandWhatCannotBeWritten) {
  const ScratchFolder folder;
  ASSERT_TRUE(make_folder(folder.path("taken")).ok());
  ASSERT_TRUE(write_file(folder.path("a.txt"), "old").ok());
  EXPECT_TRUE(check_writable(folder.path("a.txt")).ok());
  EXPECT_TRUE(check_writable(folder.path("b.txt")).ok());
  EXPECT_EQ(check_writable(folder.path("taken")).error().message,
            folder.path("taken") + ": cannot be written: it is a folder; expected a file");
  EXPECT_EQ(check_writable(folder.path("none/a.txt")).error().message,
            folder.path("none/a.txt") + ": cannot be written: No such file or directory");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.txt", "taken"}));
  EXPECT_EQ(read_file(folder.path("a.txt")).value(), "old");
}

TEST(TextFile, LeavesAloneWhatIsNoFile) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  const std::string message = folder.path("pipe") + ": cannot be written: it is a pipe or a device; expected a file";
  EXPECT_EQ(check_writable(folder.path("pipe")).error().message, message);
  EXPECT_EQ(write_file(folder.path("pipe"), "x").error().message, message);
  EXPECT_TRUE(std::filesystem::is_fifo(folder.path("pipe")));
}

TEST(TextFile, LeavesNothingBehindWhereAFolderIs) {
  const ScratchFolder folder;
  ASSERT_TRUE(make_folder(folder.path("taken/inner")).ok());
  EXPECT_EQ(write_file(folder.path("taken"), "x").error().message,
            folder.path("taken") + ": cannot be written: it is a folder; expected a file");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"taken"});
}

TEST(TextFile, KeepsTheOldFileWhenTheDiskIsFull) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder.path("a.txt"), "old").ok());
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Result<void> written = write_file(folder.path("a.txt"), std::string(5000, 'x'));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(written.error().message, folder.path("a.txt") + ": cannot be written: File too large");
  EXPECT_EQ(read_file(folder.path("a.txt")).value(), "old");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(TextFile, MakesFoldersAndTheFoldersAboveThemTwiceWithoutComplaint) {
  const ScratchFolder folder;
  EXPECT_TRUE(make_folder(folder.path("a/b/c")).ok());
  EXPECT_TRUE(make_folder(folder.path("a/b/c")).ok());
  EXPECT_TRUE(std::filesystem::is_directory(folder.path("a/b/c")));
}

TEST(TextFile, RefusesToMakeAFolderWhereAFileIs) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder.path("a"), "x").ok());
  EXPECT_FALSE(make_folder(folder.path("a")).ok());
  EXPECT_EQ(make_folder(folder.path("a")).error().message.find(folder.path("a") + ": cannot be made: "), 0U);
}

TEST(TextFile, FindsPathsBesideAFile) {
  EXPECT_EQ(beside("config/missions/a.toml", "../maps/b.toml"), "config/maps/b.toml");
  EXPECT_EQ(beside("a.toml", "b.png"), "b.png");
  EXPECT_EQ(beside("config/a.toml", "/srv/b.png"), "/srv/b.png");
}

}  // namespace
}  // namespace ivo::firmware
