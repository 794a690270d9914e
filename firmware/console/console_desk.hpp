// Where the run and its console meet: the run lays down what it is doing and what it asks; a client's answer to just
// that question, and what else clients want, lies there until the run takes it. The loop knows nothing of it.
#pragma once

#include <array>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "firmware/console/area_board.hpp"
#include "firmware/console/command_check.hpp"
#include "firmware/console/console_messages.hpp"
#include "firmware/console/document_shelf.hpp"

namespace ivo::firmware::console {

/// What does not wait for the run's thread; called from the console's, also while the run's is held up.
struct DeskHooks {
  std::function<void()> stop;
  std::function<void()> pause;
  std::function<void()> beat;
};

/// An answer to what was asked.
struct DeskAnswer {
  Kind kind{};           ///< kConsent, kNoConsent or kClearFault
  bool watched = false;  ///< of a consent: it counts only while beats come
};

/// What somebody wants of the run: kInit, kReplan, kEnough or kFound.
struct DeskRequest {
  Kind kind{};
  std::uint32_t argument = 0;
};

/// Which of a mission's agents are persons whose place comes from outside.
using Reported = std::array<bool, kAgents>;

class ConsoleDesk {
 public:
  ConsoleDesk(const BoardRules& rules, const Reported& reported, DeskHooks hooks)
      : rules_(rules), reported_(reported), hooks_(std::move(hooks)), board_(rules) {}

  // The run's thread.
  /// The newest status, and what is asked with it. Asking anew, after something else, is a new question: answers to the
  /// one before are void. While somebody's wish for another plan waits, nothing is asked.
  void show(const Status& status, Asks asks);
  /// The answer to `asks`, once.
  [[nodiscard]] std::optional<DeskAnswer> take(Asks asks);
  /// What is wanted, in order, once.
  [[nodiscard]] std::vector<DeskRequest> requests();
  /// Where agents were reported since the last call.
  [[nodiscard]] std::vector<PoseCommand> poses();
  [[nodiscard]] AreaBoard areas() const;
  /// The mission's own, before anybody draws.
  [[nodiscard]] Verdict put(const AreaCommand& area);
  [[nodiscard]] DocumentShelf& documents() noexcept { return documents_; }

  // The console's thread.
  /// What a command that is well-formed means now; acts on it where it is accepted.
  [[nodiscard]] Verdict submit(const ClientMessage& message);
  [[nodiscard]] Status status() const;
  [[nodiscard]] const DocumentShelf& documents() const noexcept { return documents_; }

 private:
  static constexpr std::size_t kRequests = 16;

  [[nodiscard]] Verdict take_word(const Command& command);
  [[nodiscard]] Verdict take_word(const AreaCommand& area);
  [[nodiscard]] Verdict take_word(const PoseCommand& pose);
  [[nodiscard]] Verdict answer(const Command& command);
  [[nodiscard]] Verdict want_plan(const Command& command);
  [[nodiscard]] Verdict want(const Command& command);
  [[nodiscard]] Verdict accept(const Command& command);
  [[nodiscard]] Verdict keep(const Command& command);
  void nothing_is_agreed();
  [[nodiscard]] bool plan_wanted() const;

  BoardRules rules_;
  Reported reported_;
  DeskHooks hooks_;
  DocumentShelf documents_;
  mutable std::mutex mutex_;  // of all below
  Status status_;
  AreaBoard board_;
  std::optional<DeskAnswer> answer_;
  bool answered_ = false;  // the question that is asked, and perhaps taken
  std::optional<std::uint32_t> accepted_plan_;
  std::vector<DeskRequest> requests_;
  std::array<std::optional<PoseCommand>, kAgents> poses_;
};

}  // namespace ivo::firmware::console
