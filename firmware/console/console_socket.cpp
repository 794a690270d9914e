#include "firmware/console/console_socket.hpp"

#include <linux/sockios.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <span>
#include <utility>

namespace ivo::firmware::console {
namespace {

using std::chrono_literals::operator""ms;

constexpr int kMessagesPerTurn = 64;     // of one client
constexpr auto kBetweenTurns = 5ms;      // so a flood costs a part of a processor, and waits at its sender
constexpr int kUnreadStatuses = 32768;   // bytes at a client that does not read: it hears news, not a backlog
constexpr int kUnreadDocuments = 24576;  // a document that is not read does not keep statuses back
constexpr int kPartsPerTurn = 4;         // of documents, to one client
constexpr auto kBetweenParts = 2ms;
constexpr auto kLastWords = 500ms;
constexpr int kUnreadBytes = 131'072;   // answers have room beyond it
constexpr std::size_t kLongest = 2048;  // bytes read of a packet; what is longer is refused by its size
constexpr auto kStatusEvery = std::chrono::nanoseconds(std::chrono::seconds(1)) / kStatusPerSecond;

template <class Message>
bool sent_whole(int socket, const Message& message) {
  return ::send(socket, &message, sizeof(message), MSG_DONTWAIT | MSG_NOSIGNAL) == sizeof(message);
}

// Signals are for the thread that waits on the terminal.
std::thread started_without_signals(auto work) {
  sigset_t all{};
  sigset_t before{};
  (void)sigfillset(&all);
  (void)pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(work);
  (void)pthread_sigmask(SIG_SETMASK, &before, nullptr);
  (void)pthread_setname_np(thread.native_handle(), "ivo-console");
  return thread;
}

// What a client has not read yet leaves room for answers: an old status is worth less than the word that a stop was
// heard.
bool keeps_up(int socket, int most) {
  int unread = 0;
  return ioctl(socket, SIOCOUTQ, &unread) == 0 && unread < most;
}

// By now: one that went since the last look reads like one that sends empty packets.
bool hung_up(int socket) {
  pollfd client{.fd = socket, .events = POLLRDHUP, .revents = 0};
  return ::poll(&client, 1, 0) != 0;
}

}  // namespace

ConsoleSocket::ConsoleSocket(Listener listener, ConsoleDesk& desk)
    : listener_(std::move(listener)),
      desk_(desk),
      ending_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_(started_without_signals([this] { serve(); })) {}

void ConsoleSocket::close() {
  if (!thread_.joinable()) {
    return;
  }
  const std::uint64_t one = 1;
  (void)!::write(ending_.get(), &one, sizeof(one));
  thread_.join();
  for (Client& client : clients_) {
    if (client.socket.valid()) {
      finish_documents(client);
      tell(client);
    }
    client.socket.close();
  }
  listener_.close();
}

// The robot may be on the move, and goes on; who waits for us hears that we are gone.
void ConsoleSocket::serve() noexcept {
  try {
    serve_turn_by_turn();
  } catch (...) {  // out of memory, say
    ++counters_.ended_early;
    for (Client& client : clients_) {
      client.socket.close();
    }
    listener_.close();
  }
}

void ConsoleSocket::serve_turn_by_turn() {
  for (;;) {
    std::array<pollfd, kClients + 2> watched{};
    watched[0] = {.fd = ending_.get(), .events = POLLIN, .revents = 0};
    watched[1] = {.fd = listener_.get(), .events = POLLIN, .revents = 0};
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      watched[i + 2] = {.fd = clients_[i].socket.get(), .events = POLLIN | POLLRDHUP, .revents = 0};
    }
    if (::poll(watched.data(), watched.size(), wait_ms()) < 0 && errno != EINTR) {
      std::this_thread::sleep_for(kStatusEvery);  // no memory, say
      continue;
    }
    if (watched[0].revents != 0) {
      return;
    }
    bool heard = false;
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      if (watched[i + 2].revents != 0) {
        hear(clients_[i]);
        heard = true;
      }
    }
    if (watched[1].revents != 0) {
      welcome();
      heard = true;
    }
    for (Client& client : clients_) {
      if (client.socket.valid() && Clock::now() >= client.status_due) {
        tell(client);
      }
      if (client.socket.valid()) {
        send_documents(client);
      }
    }
    if (heard) {
      (void)::poll(watched.data(), 1, static_cast<int>(kBetweenTurns.count()));
    }
  }
}

// One connection a turn.
void ConsoleSocket::welcome() {
  Client arrived;
  arrived.socket = hal::FileDescriptor(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!arrived.socket.valid()) {
    return;
  }
  (void)::setsockopt(arrived.socket.get(), SOL_SOCKET, SO_SNDBUF, &kUnreadBytes, sizeof(kUnreadBytes));
  const auto place = std::ranges::find_if(clients_, [](const Client& client) { return !client.socket.valid(); });
  if (place == clients_.end()) {
    answer(arrived, 0, Verdict::kTooManyClients);
    return;
  }
  *place = std::move(arrived);
}

void ConsoleSocket::hear(Client& client) {
  bool gone = false;
  for (int turn = 0; turn < kMessagesPerTurn; ++turn) {
    std::array<std::byte, kLongest> packet{};
    const ssize_t size = ::recv(client.socket.get(), packet.data(), packet.size(), MSG_DONTWAIT | MSG_TRUNC);
    if (size < 0 && errno == ECONNRESET) {
      continue;  // it went and left something unread: said once, before what it had sent
    }
    gone = size < 0 ? errno != EAGAIN && errno != EINTR : size == 0 && hung_up(client.socket.get());
    if (size < 0) {
      break;
    }
    if (gone) {
      continue;  // nothing, or an empty packet: there may be a stop behind it
    }
    const auto whole = static_cast<std::size_t>(size);
    const std::span<const std::byte> read = std::span(packet).first(std::min(whole, packet.size()));
    ClientMessage message;
    Verdict verdict = client.check.judge(read, whole, Clock::now(), message);
    if (verdict == Verdict::kAccepted) {
      verdict = desk_.submit(message);
    }
    answer(client, claimed_sequence(read), verdict);
  }
  if (gone) {
    client.socket.close();
  }
}

void ConsoleSocket::answer(Client& client, std::uint32_t of_sequence, Verdict verdict) {
  ++counters_.messages[static_cast<std::size_t>(verdict)];
  Answer answer;
  answer.header = {.kind = Kind::kAnswer, .size = sizeof(Answer), .sequence = client.sent + 1};
  answer.of_sequence = of_sequence;
  answer.verdict = verdict;
  if (sent_whole(client.socket.get(), answer)) {
    ++client.sent;
  } else {
    ++counters_.answers_dropped;
  }
}

void ConsoleSocket::tell(Client& client) {
  Status status = desk_.status();
  status.header = {.kind = Kind::kStatus, .size = sizeof(Status), .sequence = client.sent + 1};
  status.messages = counters_.messages;
  status.answers_dropped = counters_.answers_dropped;
  status.statuses_dropped = counters_.statuses_dropped;
  status.clients = clients_here();
  if (keeps_up(client.socket.get(), kUnreadStatuses) && sent_whole(client.socket.get(), status)) {
    ++client.sent;
  } else {
    ++counters_.statuses_dropped;
  }
  client.status_due = Clock::now() + kStatusEvery;
}

// The report, above all. A client that does not read keeps the run from ending for a moment, and no longer.
void ConsoleSocket::finish_documents(Client& client) {
  const Clock::time_point until = Clock::now() + kLastWords;
  for (send_documents(client); client.documents_due && Clock::now() < until; send_documents(client)) {
    std::this_thread::sleep_for(kBetweenParts);
  }
}

void ConsoleSocket::send_documents(Client& client) {
  const DocumentShelf& shelf = std::as_const(desk_).documents();
  for (int turn = 0; turn < kPartsPerTurn; ++turn) {
    const DocumentPart* const part = client.documents.next(shelf);
    client.documents_due = part != nullptr;
    if (part == nullptr || !keeps_up(client.socket.get(), kUnreadDocuments)) {
      return;
    }
    DocumentPart numbered = *part;
    numbered.header.sequence = client.sent + 1;
    if (!sent_whole(client.socket.get(), numbered)) {
      return;
    }
    ++client.sent;
    client.documents.sent();
  }
}

int ConsoleSocket::wait_ms() const {
  Clock::time_point due = Clock::time_point::max();
  for (const Client& client : clients_) {
    if (client.socket.valid()) {
      due = std::min(due, client.status_due);
      due = client.documents_due ? std::min<Clock::time_point>(due, Clock::now() + kBetweenParts) : due;
    }
  }
  if (due == Clock::time_point::max()) {
    return -1;
  }
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(due - Clock::now());
  return static_cast<int>(std::clamp(left, 0ms, 1000ms).count());
}

std::uint32_t ConsoleSocket::clients_here() const {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(clients_, [](const Client& client) { return client.socket.valid(); }));
}

}  // namespace ivo::firmware::console
