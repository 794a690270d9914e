// The controller's end of the console: a local socket, and a thread of ordinary priority that serves it. Whoever is at
// the other end may die, hang or flood: the thread never waits for a client, takes a bounded number of messages from
// each in a turn, and touches nothing of the loop but the desk.
#pragma once

#include <array>
#include <chrono>
#include <thread>

#include "firmware/console/command_check.hpp"
#include "firmware/console/console_desk.hpp"
#include "firmware/console/console_messages.hpp"
#include "firmware/console/document_sender.hpp"
#include "firmware/console/socket_path.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::firmware::console {

/// Of all clients so far.
struct SocketCounters {
  std::array<std::uint64_t, kVerdicts> messages{};  ///< by Verdict
  std::uint64_t answers_dropped = 0;
  std::uint64_t statuses_dropped = 0;
  std::uint64_t ended_early = 0;  ///< 1: the thread failed, and nobody was served from then on
};

class ConsoleSocket {
 public:
  /// Serves from now on who has connected at `listener`. `desk` outlives this.
  ConsoleSocket(Listener listener, ConsoleDesk& desk);
  ConsoleSocket(const ConsoleSocket&) = delete;
  ConsoleSocket& operator=(const ConsoleSocket&) = delete;
  ~ConsoleSocket() { close(); }

  /// Clients hear the last status; thread and socket end, the path goes. Again: nothing.
  void close();
  /// Once closed.
  [[nodiscard]] const SocketCounters& counters() const noexcept { return counters_; }

 private:
  using Clock = RateLimit::Clock;
  struct Client {
    hal::FileDescriptor socket;
    CommandCheck check;
    std::uint32_t sent = 0;  // our own sequence
    Clock::time_point status_due{};
    DocumentSender documents;
    bool documents_due = false;
  };

  void serve() noexcept;
  void serve_turn_by_turn();
  void welcome();
  void hear(Client& client);
  void answer(Client& client, std::uint32_t of_sequence, Verdict verdict);
  void tell(Client& client);
  void send_documents(Client& client);
  void finish_documents(Client& client);
  [[nodiscard]] int wait_ms() const;
  [[nodiscard]] std::uint32_t clients_here() const;

  Listener listener_;
  ConsoleDesk& desk_;
  hal::FileDescriptor ending_;  // readable when the thread is to end
  std::array<Client, kClients> clients_{};
  SocketCounters counters_;
  std::thread thread_;
};

}  // namespace ivo::firmware::console
