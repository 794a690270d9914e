// Where the run and its console meet: the run lays down what it is doing and what it asks; a client's answer to just
// that question lies there until the run takes it. The loop knows nothing of it.
#pragma once

#include <functional>
#include <mutex>
#include <optional>

#include "firmware/console/command_check.hpp"
#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::console {

class ConsoleDesk {
 public:
  /// `stop` asks the robot to stop; called from the console's thread at any time, also while the run's thread is held
  /// up.
  explicit ConsoleDesk(std::function<void()> stop) : stop_(std::move(stop)) {}

  // The run's thread.
  /// The newest status, and what is asked with it. Asking anew, after something else, is a new question: answers to the
  /// one before are void.
  void show(const Status& status, Asks asks);
  /// The answer to `asks`, once: kConsent, kNoConsent or kClearFault.
  [[nodiscard]] std::optional<Kind> take(Asks asks);

  // The console's thread.
  /// What a command that is well-formed means now; acts on it where it is accepted.
  [[nodiscard]] Verdict submit(const ClientMessage& message);
  [[nodiscard]] Status status() const;

 private:
  [[nodiscard]] Verdict answer(const Command& command);

  std::function<void()> stop_;
  mutable std::mutex mutex_;
  Status status_;
  std::optional<Kind> answer_;
  bool answered_ = false;  // the question that is asked, and perhaps taken
};

}  // namespace ivo::firmware::console
