#include "firmware/console/console_socket.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <vector>

#include "firmware/console/console_client.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ivo::firmware::console {
namespace {

class ConsoleSocketTest : public testing::Test {
 protected:
  std::string path() const { return folder_.path("console"); }
  std::string refusal(const std::string& path) const {
    const Result<Listener> listener = Listener::at(path);
    return listener.ok() ? "taken" : listener.error().message;
  }
  void serve() { socket_.emplace(std::move(Listener::at(path())).value(), desk_); }
  // However busy this machine is.
  ConsoleClient client() const { return ConsoleClient::connect(path(), std::chrono::minutes(5)).value(); }
  std::uint64_t count(Verdict verdict) {
    socket_->close();
    return socket_->counters().messages[static_cast<std::size_t>(verdict)];
  }

  ScratchFolder folder_;
  std::atomic<int> stops_{0};
  ConsoleDesk desk_{
      {.agents = 2, .width_m = 20, .height_m = 10}, {}, {.stop = [this] { ++stops_; }, .pause = [] {}, .beat = [] {}}};
  std::optional<ConsoleSocket> socket_;
};

TEST_F(ConsoleSocketTest, IsForOwnerAndGroupWhateverTheUmask) {
  const mode_t before = ::umask(0077);
  const Result<Listener> listener = Listener::at(path());
  (void)::umask(before);
  ASSERT_TRUE(listener.ok());
  struct stat status {};
  ASSERT_EQ(::stat(path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0660U);
}

TEST_F(ConsoleSocketTest, TakesItsPathAwayWithIt) {
  { const Result<Listener> listener = Listener::at(path()); }
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(ConsoleSocketTest, LeavesAPathThatIsSomebodyElsesByNow) {
  {
    const Result<Listener> listener = Listener::at(path());
    std::filesystem::remove(path());
    (void)folder_.put("console", "text");
  }
  EXPECT_TRUE(std::filesystem::exists(path()));
}

TEST_F(ConsoleSocketTest, ReplacesTheSocketOfAProcessThatDied) {
  {
    const Result<Listener> dead = Listener::at(path());
    std::filesystem::create_hard_link(path(), folder_.path("kept"));
  }
  std::filesystem::rename(folder_.path("kept"), path());
  EXPECT_EQ(refusal(path()), "taken");
}

TEST_F(ConsoleSocketTest, RefusesASocketThatIsListenedAtByName) {
  const Result<Listener> alive = Listener::at(path());
  EXPECT_EQ(refusal(path()), path() + ": another process listens there; expected one controller at a time");
  EXPECT_TRUE(std::filesystem::exists(path()));
}

TEST_F(ConsoleSocketTest, RefusesWhatIsNoSocketAndLeavesIt) {
  (void)folder_.put("console", "precious");
  EXPECT_EQ(refusal(path()), path() + ": is there already and is no socket; expected a name that is free");
  EXPECT_EQ(std::filesystem::file_size(path()), 8U);
}

TEST_F(ConsoleSocketTest, RefusesNamesThatNoSocketCanHave) {
  EXPECT_EQ(refusal(""), "\"\" is no name for a socket; expected a path of 1 to 107 bytes");
  EXPECT_NE(refusal(folder_.path(std::string(120, 'x'))).find("expected a path of 1 to 107 bytes"), std::string::npos);
  EXPECT_NE(refusal(folder_.path("not/there")).find("No such file or directory"), std::string::npos);
}

TEST_F(ConsoleSocketTest, SaysThatNobodyListens) {
  const Result<ConsoleClient> client = ConsoleClient::connect(path());
  ASSERT_FALSE(client.ok());
  EXPECT_NE(client.error().message.find("nobody listens there"), std::string::npos);
}

TEST_F(ConsoleSocketTest, AnswersAndTells) {
  Status shown;
  shown.cycles = 4711;
  desk_.show(shown, Asks::kConsent);
  serve();
  ConsoleClient somebody = client();
  const Result<Status> status = somebody.status();
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_EQ(status.value().cycles, 4711U);
  EXPECT_EQ(status.value().clients, 1U);
  EXPECT_EQ(somebody.command(Kind::kPing, 0).value(), Verdict::kAccepted);
  EXPECT_EQ(somebody.command(Kind::kClearFault, status.value().question).value(), Verdict::kNotAsked);
  EXPECT_EQ(somebody.command(Kind::kConsent, status.value().question).value(), Verdict::kAccepted);
  EXPECT_EQ(desk_.take(Asks::kConsent).value().kind, Kind::kConsent);
  EXPECT_EQ(somebody.command(Kind::kStop, 0).value(), Verdict::kAccepted);
  EXPECT_EQ(stops_, 1);
  EXPECT_EQ(count(Verdict::kAccepted), 3U);
  EXPECT_EQ(count(Verdict::kNotAsked), 1U);
}

TEST_F(ConsoleSocketTest, HearsWhoConnectedBeforeItServed) {
  Listener listener = std::move(Listener::at(path())).value();
  ConsoleClient early = client();
  socket_.emplace(std::move(listener), desk_);
  EXPECT_EQ(early.command(Kind::kStop, 0).value(), Verdict::kAccepted);
  EXPECT_EQ(stops_, 1);
}

TEST_F(ConsoleSocketTest, AFailureEndsItAndNothingElse) {
  ConsoleDesk failing({.agents = 2, .width_m = 20, .height_m = 10}, {},
                      {.stop = [] { throw std::bad_alloc(); }, .pause = [] {}, .beat = [] {}});
  socket_.emplace(std::move(Listener::at(path())).value(), failing);
  ConsoleClient somebody = client();
  EXPECT_FALSE(somebody.command(Kind::kStop, 0).ok()) << "nobody answers any more";
  socket_->close();
  EXPECT_EQ(socket_->counters().ended_early, 1U);
  EXPECT_EQ(refusal(path()), "taken") << "the path is free again";
}

TEST_F(ConsoleSocketTest, RefusesOneClientTooMany) {
  serve();
  std::vector<ConsoleClient> clients;
  for (int i = 0; i < kClients; ++i) {
    clients.push_back(client());
    ASSERT_TRUE(clients.back().status().ok()) << i;
  }
  ConsoleClient late = client();
  const Result<Status> status = late.status();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("4 clients are connected already"), std::string::npos);
  clients.pop_back();
  // The thread sees in its own time that one has gone.
  while (!client().status().ok()) {
  }
  EXPECT_GE(count(Verdict::kTooManyClients), 1U);
}

TEST_F(ConsoleSocketTest, RefusesPacketsOfEverySizeAndGoesOn) {
  serve();
  const hal::FileDescriptor raw = connect_to(path()).value();
  std::vector<std::byte> packet(4096);
  std::uint64_t said = 0;
  for (const std::size_t size : {0U, 1U, 15U, 16U, 23U, 25U, 1023U, 1024U, 1025U, 4096U}) {
    ASSERT_EQ(::send(raw.get(), packet.data(), size, 0), static_cast<ssize_t>(size));
    ++said;
  }
  // Each has its answer, among statuses.
  for (std::uint64_t answered = 0; answered < said;) {
    const ssize_t size = ::recv(raw.get(), packet.data(), packet.size(), 0);
    ASSERT_GT(size, 0);
    answered += size == sizeof(Answer) ? 1 : 0;
  }
  EXPECT_EQ(client().command(Kind::kPing, 0).value(), Verdict::kAccepted);
  EXPECT_EQ(count(Verdict::kWrongSize), 4U) << "too short for a header, or longer than is read";
  EXPECT_EQ(count(Verdict::kWrongMagic), said - 4);
}

TEST_F(ConsoleSocketTest, HearsTheStopOfOneThatWentWithoutReading) {
  serve();
  ConsoleClient other = client();
  ASSERT_TRUE(other.status().ok());
  {
    const hal::FileDescriptor hasty = connect_to(path()).value();
    // Served by now, and a status lies there.
    pollfd first{.fd = hasty.get(), .events = POLLIN, .revents = 0};
    ASSERT_EQ(::poll(&first, 1, -1), 1);
    while (other.status().value().clients != 2) {
    }
    ASSERT_EQ(::send(hasty.get(), nullptr, 0, 0), 0);  // and behind an empty packet
    const Command stop{.header = {.kind = Kind::kStop, .size = sizeof(Command), .sequence = 1}};
    ASSERT_EQ(::send(hasty.get(), &stop, sizeof(stop), 0), static_cast<ssize_t>(sizeof(stop)));
  }
  while (other.status().value().clients != 1) {
  }
  EXPECT_EQ(stops_, 1);
}

TEST_F(ConsoleSocketTest, NeverWaitsForAClientThatDoesNotRead) {
  serve();
  const hal::FileDescriptor deaf = connect_to(path()).value();
  ConsoleClient other = client();
  for (Status seen; seen.statuses_dropped == 0 || seen.answers_dropped == 0; seen = other.status().value()) {
    for (int i = 0; i < 100; ++i) {
      const std::byte garbage{};
      (void)::send(deaf.get(), &garbage, 1, MSG_DONTWAIT);
    }
  }
  EXPECT_EQ(other.command(Kind::kStop, 0).value(), Verdict::kAccepted);
  EXPECT_EQ(stops_, 1);
  socket_->close();
  EXPECT_GT(socket_->counters().answers_dropped, 0U);
}

}  // namespace
}  // namespace ivo::firmware::console
