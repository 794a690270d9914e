#include "firmware/record/state_writer.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <utility>

namespace ivo::firmware {
namespace {

// Signals are for the thread that waits for answers.
class SignalsBlocked {
 public:
  SignalsBlocked() noexcept {
    sigset_t all;
    (void)sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { (void)pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

StateWriter::StateWriter(StateFile file, int log) : file_(std::move(file)), log_(::fcntl(log, F_DUPFD_CLOEXEC, 0)) {
  const SignalsBlocked blocked;
  thread_ = std::thread([this] { write_in_turn(); });
}

StateWriter::~StateWriter() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
  if (log_ >= 0) {
    ::close(log_);
  }
}

void StateWriter::keep(std::string state) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    next_ = std::move(state);
    ++handed_over_;
  }
  changed_.notify_all();
}

Result<void> StateWriter::keep_and_wait(std::string state) {
  keep(std::move(state));
  std::unique_lock<std::mutex> lock(mutex_);
  const std::uint64_t mine = handed_over_;
  changed_.wait(lock, [&] { return done_ >= mine; });
  return failure_ ? Result<void>(*failure_) : Result<void>();
}

std::optional<Error> StateWriter::failure() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

// What it throws would end the program, and with it a search under way.
Result<void> StateWriter::written(const std::string& state) noexcept {
  try {
    // The log first: a state never speaks of a line that a power cut could still take. A log that cannot be synced (a
    // pipe) is no reason to keep nothing.
    (void)::fdatasync(log_);
    return file_.keep(state);
  } catch (...) {
    return Error{"out of memory"};  // short enough to need none
  }
}

void StateWriter::write_in_turn() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return next_ || closing_; });
    if (!next_) {
      return;
    }
    const std::string state = std::move(*next_);
    next_.reset();
    const std::uint64_t number = handed_over_;
    lock.unlock();
    const Result<void> kept = written(state);
    lock.lock();
    failure_ = kept ? std::nullopt : std::optional<Error>(kept.error());
    done_ = number;
    changed_.notify_all();
  }
}

}  // namespace ivo::firmware
