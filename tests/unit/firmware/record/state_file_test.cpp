#include "firmware/record/state_file.hpp"

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace ivo::firmware {
namespace {

using Kind = FoundState::Kind;
constexpr std::uint32_t kVersion = 7;

class StateFileTest : public ::testing::Test {
 protected:
  StateFileTest() {
    std::string folder = ::testing::TempDir() + "state.XXXXXX";
    folder_ = ::mkdtemp(folder.data());
    path_ = folder_ + "/state";
  }
  ~StateFileTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] FoundState found() const {
    Result<FoundState> read = StateFile::read(path_, kVersion);
    EXPECT_TRUE(read.ok());
    return read.value();
  }
  [[nodiscard]] StateFile created(std::string_view state) const {
    Result<StateFile> file = StateFile::create(path_, kVersion, found(), state);
    EXPECT_TRUE(file.ok());
    return file.value();
  }
  [[nodiscard]] std::string slot(int number) const {
    std::ifstream file(path_ + "." + std::to_string(number), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void put(int number, const std::string& bytes) const {
    std::ofstream file(path_ + "." + std::to_string(number), std::ios::binary);
    file << bytes;
  }

  std::string folder_;
  std::string path_;
};

TEST_F(StateFileTest, TheNewestStateIsFound) {
  EXPECT_EQ(found().kind, Kind::kNone);
  StateFile file = created("first");
  EXPECT_EQ(found().state, "first");
  for (const char* const state : {"second, which is longer", "third", "", "fifth"}) {
    ASSERT_TRUE(file.keep(state).ok());
    EXPECT_EQ(found().kind, Kind::kWhole);
    EXPECT_EQ(found().state, state);
    EXPECT_FALSE(found().other_torn);
  }
}

TEST_F(StateFileTest, AnotherProcessGoesOnWhereTheFirstOneEnded) {
  StateFile file = created("first");
  ASSERT_TRUE(file.keep("second").ok());
  StateFile next(path_, kVersion, found());
  ASSERT_TRUE(next.keep("third").ok());
  EXPECT_EQ(found().state, "third");
  EXPECT_EQ(found().sequence, 3U);
}

TEST_F(StateFileTest, ANewBeginningIsNewerThanWhatWasThere) {
  StateFile file = created("old");
  ASSERT_TRUE(file.keep("older").ok());
  (void)created("new");
  EXPECT_EQ(found().state, "new");
  EXPECT_FALSE(std::filesystem::exists(path_ + ".1"));
}

TEST_F(StateFileTest, EveryTruncationIsSeenAndTheOtherSlotTaken) {
  StateFile file = created("the first state");
  ASSERT_TRUE(file.keep("the second state").ok());
  const std::string whole = slot(1);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    put(1, whole.substr(0, length));
    const FoundState state = found();
    EXPECT_EQ(state.kind, Kind::kWhole) << length;
    EXPECT_EQ(state.state, "the first state") << length;
    EXPECT_EQ(state.other_torn, length > 0) << length;
  }
}

TEST_F(StateFileTest, EveryFlippedBitIsSeen) {
  StateFile file = created("the first state");
  ASSERT_TRUE(file.keep("the second state").ok());
  const std::string whole = slot(1);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    put(1, flipped);
    EXPECT_EQ(found().state, "the first state") << bit;
    EXPECT_TRUE(found().other_torn) << bit;
  }
}

TEST_F(StateFileTest, EveryByteOfEveryOtherValueIsSeenWhenThereIsNoOtherSlot) {
  (void)created("state");
  const std::string whole = slot(0);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int change = 1; change < 256; ++change) {
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ change);
      put(0, changed);
      ASSERT_EQ(found().kind, Kind::kDamaged) << at << " " << change;
    }
  }
}

TEST_F(StateFileTest, WhatIsTornWhileItIsWrittenOverAnOldOneIsTheOneBefore) {
  StateFile file = created("one");
  ASSERT_TRUE(file.keep("two, the longest of the four").ok());
  const std::string old = slot(0);
  ASSERT_TRUE(file.keep("three, as it is").ok());
  const std::string fresh = slot(0);
  for (std::size_t length = 0; length <= fresh.size(); ++length) {
    put(0, fresh.substr(0, length) + (length < old.size() ? old.substr(length) : ""));
    const std::string state = found().state;
    EXPECT_EQ(state, length == fresh.size() ? "three, as it is" : "two, the longest of the four") << length;
  }
}

TEST_F(StateFileTest, BothDamagedIsSaidAndNotTakenForNothing) {
  StateFile file = created("first");
  ASSERT_TRUE(file.keep("second").ok());
  put(0, "rubbish");
  put(1, "rubbish");
  EXPECT_EQ(found().kind, Kind::kDamaged);
}

TEST_F(StateFileTest, AForeignVersionIsSaidByItsNumber) {
  (void)StateFile::create(path_, kVersion + 1, {}, "of the future");
  EXPECT_EQ(found().kind, Kind::kForeign);
  EXPECT_EQ(found().version, kVersion + 1);
}

TEST_F(StateFileTest, WhatIsSetAsideIsWholeUnderItsNewName) {
  StateFile file = created("first");
  ASSERT_TRUE(file.keep("second").ok());
  ASSERT_TRUE(StateFile::set_aside(path_, folder_ + "/previous").ok());
  EXPECT_EQ(found().kind, Kind::kNone);
  const Result<FoundState> previous = StateFile::read(folder_ + "/previous", kVersion);
  ASSERT_TRUE(previous.ok());
  EXPECT_EQ(previous.value().state, "second");
}

TEST_F(StateFileTest, AFolderThatIsNotThereIsSaid) {
  const Result<StateFile> file = StateFile::create(folder_ + "/not/there", kVersion, {}, "state");
  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().message, folder_ + "/not/there.new: cannot be written: No such file or directory");
}

TEST_F(StateFileTest, AFullDiskIsSaidAndTheNewestStateStays) {
  StateFile file = created("small");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit full{.rlim_cur = 100, .rlim_max = before.rlim_max};
  void (*const action)(int) = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  const Result<void> kept = file.keep(std::string(1000, 'x'));
  const Result<void> small = file.keep("small again");
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  (void)std::signal(SIGXFSZ, action);
  ASSERT_FALSE(kept.ok());
  EXPECT_EQ(kept.error().message, path_ + ".1: cannot be written: File too large");
  EXPECT_TRUE(small.ok());
  EXPECT_EQ(found().state, "small again");
}

// A child that is ended before its `calls`-th stop at a system call, entered or left. True when it came to its end.
bool ended_before(int calls, void (*work)(const std::string&), const std::string& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) {
      ::_exit(99);
    }
    (void)std::raise(SIGSTOP);
    work(path);
    ::_exit(0);
  }
  int status = 0;
  (void)::waitpid(child, &status, 0);
  for (int n = 0; n < calls && WIFSTOPPED(status); ++n) {
    (void)::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    (void)::waitpid(child, &status, 0);
  }
  if (WIFSTOPPED(status)) {
    (void)::kill(child, SIGKILL);
    (void)::waitpid(child, &status, 0);
    return false;
  }
  return true;
}

bool can_trace() {
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0 ? 0 : 1);
  }
  int status = 0;
  (void)::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void begin_and_keep_three(const std::string& path) {
  const Result<FoundState> before = StateFile::read(path, kVersion);
  Result<StateFile> file = StateFile::create(path, kVersion, before.value(), "1");
  (void)file.value().keep("2, longer");
  (void)file.value().keep("3");
  (void)file.value().keep("4, as long as none before it");
}

TEST_F(StateFileTest, AKillBetweenAnyTwoSystemCallsLeavesAWholeState) {
  if (!can_trace()) {
    GTEST_SKIP() << "system calls cannot be traced here";
  }
  constexpr int kMostCalls = 1000;
  const std::vector<std::string> in_order = {"0, of a run before", "1", "2, longer", "3",
                                             "4, as long as none before it"};
  std::vector<bool> seen(in_order.size(), false);
  std::ptrdiff_t reached = 0;
  int calls = 0;
  for (bool ended = false; !ended; ++calls) {
    ASSERT_LT(calls, kMostCalls);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
    StateFile before = created("00");
    ASSERT_TRUE(before.keep(in_order.front()).ok());
    ended = ended_before(calls, begin_and_keep_three, path_);
    const FoundState state = found();
    ASSERT_EQ(state.kind, Kind::kWhole) << calls;
    const auto place = std::find(in_order.begin(), in_order.end(), state.state);
    ASSERT_NE(place, in_order.end()) << calls << ": " << state.state;
    ASSERT_GE(place - in_order.begin(), reached) << "a later kill keeps no less";
    reached = place - in_order.begin();
    seen[static_cast<std::size_t>(reached)] = true;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), static_cast<std::ptrdiff_t>(seen.size()));
  EXPECT_GT(calls, 40);
}

}  // namespace
}  // namespace ivo::firmware
